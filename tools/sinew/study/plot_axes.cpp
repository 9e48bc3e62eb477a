#include "sinew/study/plot_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sinew::tools::study {

namespace {

constexpr Box box{.left = 66, .top = 40, .right = plotWidth - 16, .bottom = plotHeight - 54};
constexpr double lowestError = 1e-9; // below the resolution of float32

bool hasWhisker(const PlotPoint& point) {
    return point.least > 0 && point.most > point.least;
}

double share(double value, double low, double high) {
    return std::log(value / low) / std::log(high / low);
}

std::string superscript(int value) {
    static constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = value < 0 ? "⁻" : "";
    for (const char c : std::to_string(std::abs(value))) text += digits[c - '0'];
    return text;
}

} // namespace

double Axes::x(double value) const {
    if (kind == PlotKind::overTime) return box.left + value / xHigh * (box.right - box.left);
    return box.left + share(value, xLow, xHigh) * (box.right - box.left);
}

double Axes::y(double value) const {
    const double clamped = std::clamp(value, yLow, yHigh);
    return box.bottom - share(clamped, yLow, yHigh) * (box.bottom - box.top);
}

namespace {

Axes axesOverTime(const Plot& plot) {
    Axes axes{.box = box, .kind = plot.kind, .xLow = 0, .xHigh = 0, .yLow = INFINITY, .yHigh = 0};
    for (const PlotCurve& curve : plot.curves)
        for (const PlotPoint& point : curve.points) {
            axes.xHigh = std::max(axes.xHigh, point.x);
            if (!point.y || *point.y <= 0) continue;
            axes.yLow = std::min(axes.yLow, *point.y);
            axes.yHigh = std::max(axes.yHigh, *point.y);
        }
    if (!(axes.xHigh > 0)) axes.xHigh = 1;
    if (!(axes.yHigh > 0)) axes.yLow = axes.yHigh = 1;
    axes.yHigh = std::pow(10, std::ceil(std::log10(axes.yHigh) - 1e-9));
    axes.yLow = std::pow(10, std::floor(std::log10(axes.yLow) + 1e-9));
    axes.yLow = std::clamp(axes.yLow, 1e-9 * axes.yHigh, 0.1 * axes.yHigh);
    return axes;
}

} // namespace

Axes axesFor(const Plot& plot) {
    if (plot.kind == PlotKind::overTime) return axesOverTime(plot);
    Axes axes{.box = box,
              .xLow = INFINITY,
              .xHigh = 0,
              .yLow = plot.target / 10,
              .yHigh = 1,
              .target = plot.target,
              .standing = plot.standing};
    if (plot.standing > 0) {
        axes.yLow = std::min(axes.yLow, plot.standing);
        axes.yHigh = std::max(axes.yHigh, plot.standing);
    }
    for (const PlotCurve& curve : plot.curves)
        for (const PlotPoint& point : curve.points) {
            axes.xLow = std::min(axes.xLow, hasWhisker(point) ? point.least : point.x);
            axes.xHigh = std::max({axes.xHigh, point.x, hasWhisker(point) ? point.most : 0});
            if (!point.y) continue;
            axes.yLow = std::min(axes.yLow, std::max(*point.y, lowestError));
            axes.yHigh = std::max(axes.yHigh, *point.y);
        }
    if (!(axes.xLow <= axes.xHigh)) axes.xLow = axes.xHigh = 1; // no points
    const double room = std::max(1.15, std::pow(axes.xHigh / axes.xLow, 0.04));
    axes.xLow /= room;
    axes.xHigh *= room;
    axes.yLow = std::pow(10, std::floor(std::log10(axes.yLow) + 1e-9));
    axes.yHigh = std::pow(10, std::ceil(std::log10(axes.yHigh) - 1e-9));
    return axes;
}

std::vector<double> ticks(double low, double high) {
    std::vector<double> values;
    const int first = static_cast<int>(std::floor(std::log10(low))),
              last = static_cast<int>(std::ceil(std::log10(high)));
    const bool isFine = std::log10(high / low) < 2.6;
    for (int decade = first; decade <= last; ++decade)
        for (const double step : {1.0, 2.0, 5.0}) {
            const double value = step * std::pow(10, decade);
            if ((step == 1 || isFine) && value >= low * 0.999 && value <= high * 1.001)
                values.push_back(value);
        }
    return values;
}

std::string percentText(double share) {
    const double percent = 100 * share;
    if (percent > 0.9e-3) return fmt::format("{:.6g} %", percent);
    return "10" + superscript(static_cast<int>(std::lround(std::log10(percent)))) + " %";
}

std::vector<double> linearTicks(double high) {
    const double decade = std::pow(10, std::floor(std::log10(high)) - 1);
    double step = decade;
    for (const double factor : {2.0, 5.0, 10.0, 20.0})
        if (high / step > 10) step = factor * decade;
    std::vector<double> values;
    for (int i = 0; i * step <= high * 1.001; ++i) values.push_back(i * step);
    return values;
}

namespace {

/// A power of ten.
std::string powerText(double value) {
    const int power = static_cast<int>(std::lround(std::log10(value)));
    return std::abs(power) <= 3 ? fmt::format("{:g}", std::pow(10, power)) : "10" + superscript(power);
}

} // namespace

std::string drawAxes(const Axes& axes, const std::string& xLabel) {
    std::string grid, text;
    const bool isOverTime = axes.kind == PlotKind::overTime;
    for (const double value : isOverTime ? linearTicks(axes.xHigh) : ticks(axes.xLow, axes.xHigh)) {
        const double x = axes.x(value);
        grid += fmt::format("M{:.1f} {:.1f}V{:.1f}", x, axes.box.top, axes.box.bottom);
        text += fmt::format(
            "<text class=\"muted\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{:g}</text>\n", x,
            axes.box.bottom + 17, value);
    }
    for (double value = axes.yLow; value < axes.yHigh * 1.5; value *= 10) {
        const double y = axes.y(value);
        grid += fmt::format("M{:.1f} {:.1f}H{:.1f}", axes.box.left, y, axes.box.right);
        text += fmt::format("<text class=\"muted\" text-anchor=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                            axes.box.left - 7, y + 4.4, isOverTime ? powerText(value) : percentText(value));
    }
    const Box& b = axes.box;
    const auto level = [&](const char* kind, double error) {
        return fmt::format("<path class=\"{}\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n", kind, b.left, axes.y(error),
                           b.right);
    };
    std::string target;
    if (!isOverTime) target += level("target", axes.target);
    if (axes.standing > 0)
        target += level("standing", axes.standing) +
                  fmt::format("<text class=\"muted\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", b.left + 6,
                              axes.y(axes.standing) - 5, standingText);
    return fmt::format(
        "<path class=\"grid\" d=\"{}\"/>\n<path class=\"frame\" d=\"M{:.1f} {:.1f}V{:.1f}H{:.1f}\"/>\n"
        "{}{}"
        "<text class=\"ink\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
        grid, b.left, b.top, b.bottom, b.right, target, text, (b.left + b.right) / 2, b.bottom + 40,
        escaped(xLabel));
}

} // namespace sinew::tools::study
