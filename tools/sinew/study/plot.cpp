// Lengths are in SVG user units: the drawing is 440 wide and scales with the page.
#include "sinew/study/plot.hpp"

#include "sinew/study/plot_axes.hpp"
#include "sinew/study/plot_labels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sinew::tools::study {

namespace {

constexpr std::size_t nobody = 1000;                 // no solver's slot
constexpr double frontRadius = 4, faintRadius = 2.3; // of markers

std::string marker(std::size_t slot, double x, double y, double r, const char* kind) {
    switch (slot % 4) {
    case 0:
        return fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>", kind, x, y, r);
    case 1:
        return fmt::format(
            "<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>", kind,
            x - 0.9 * r, y - 0.9 * r, 1.8 * r, 1.8 * r);
    case 2:
        return fmt::format(
            "<path class=\"{0}\" d=\"M{1:.1f} {2:.1f}l{3:.1f} {3:.1f}l-{3:.1f} {3:.1f}l-{3:.1f} "
            "-{3:.1f}z\"/>",
            kind, x, y - 1.25 * r, 1.25 * r);
    default:
        return fmt::format("<path class=\"{0}\" d=\"M{1:.1f} {2:.1f}l{3:.1f} {4:.1f}h-{5:.1f}z\"/>", kind, x,
                           y - 1.2 * r, 1.2 * r, 2.1 * r, 2.4 * r);
    }
}

std::string path(const std::vector<Spot>& spots) {
    std::string d;
    for (const Spot& spot : spots) d += fmt::format("{}{:.1f} {:.1f}", d.empty() ? "M" : "L", spot.x, spot.y);
    return d;
}

std::vector<Spot> frontOf(const PlotCurve& curve, const Axes& axes) {
    std::vector<Spot> spots;
    for (const PlotPoint& point : curve.points)
        if (point.isOnFront && point.y) spots.push_back({axes.x(point.x), axes.y(*point.y)});
    return spots;
}

/// The best of all solvers: a broad band under the curves, along the points that no other undercuts.
std::string bestOfAll(const Plot& plot, const Axes& axes) {
    if (plot.kind == PlotKind::overTime) return {};
    std::vector<std::pair<double, double>> all;
    for (const PlotCurve& curve : plot.curves)
        for (const PlotPoint& point : curve.points)
            if (point.isOnFront && point.y) all.emplace_back(point.x, *point.y);
    std::ranges::sort(all);
    std::vector<Spot> spots;
    double best = INFINITY;
    for (const auto& [x, y] : all) {
        if (y >= best) continue;
        best = y;
        spots.push_back({axes.x(x), axes.y(y)});
    }
    return spots.size() < 2 ? "" : fmt::format("<path class=\"best\" d=\"{}\"/>\n", path(spots));
}

std::string draw(const PlotCurve& curve, const Axes& axes) {
    std::string faint, marks;
    for (const PlotPoint& point : curve.points) {
        const double x = axes.x(point.x);
        if (!point.y) // a small wedge that points out of the diagram
            marks +=
                fmt::format("<path class=\"hollow\" d=\"M{:.1f} {:.1f}l5 9h-10z\"/>", x, axes.box.top - 4);
        else if (axes.kind == PlotKind::overTime)
            continue; // drawn as a line
        else if (point.isOnFront) {
            if (point.most > point.least)
                marks += fmt::format("<path class=\"whisker\" d=\"M{0:.1f} {1:.1f}v6m0 -3H{2:.1f}m0 -3v6\"/>",
                                     axes.x(point.least), axes.y(*point.y) - 3, axes.x(point.most));
            marks += marker(curve.slot, x, axes.y(*point.y), frontRadius, "dot");
        } else
            faint += marker(curve.slot, x, axes.y(*point.y), faintRadius, "faint");
    }
    std::string target;
    if (curve.xAtTarget && axes.holdsX(*curve.xAtTarget)) {
        const double x = axes.x(*curve.xAtTarget), y = axes.y(axes.target);
        target = fmt::format("<path class=\"drop\" d=\"M{0:.1f} {1:.1f}V{2:.1f}\"/><circle class=\"ring\" "
                             "cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"6.5\"/>",
                             x, y, axes.box.bottom);
    }
    const std::vector<Spot> front = frontOf(curve, axes);
    const std::string line =
        front.size() < 2 ? "" : fmt::format("<path class=\"line\" d=\"{}\"/>", path(front));
    return fmt::format("<g class=\"s{}\">{}{}{}{}</g>\n", curve.slot % 6, faint, target, line, marks);
}

/// Labels cover neither markers, their own ones included, nor whiskers.
void avoidMarks(LabelPlacer& placer, const PlotCurve& curve, const Axes& axes) {
    if (axes.kind == PlotKind::overTime) return;
    for (const PlotPoint& point : curve.points) {
        const double y = point.y ? axes.y(*point.y) : axes.box.top;
        placer.avoidMark({axes.x(point.x), y}, point.isOnFront || !point.y ? frontRadius : faintRadius);
        if (!point.isOnFront || !(point.most > point.least)) continue;
        placer.avoid({{axes.x(point.least), y}, {axes.x(point.most), y}}, nobody);
    }
}

} // namespace

std::string plotStyle() {
    return R"(.plot{font:12.5px system-ui,"DejaVu Sans",sans-serif}
.plot .paper{fill:#fff}.plot .ink{fill:#16191d}.plot .muted{fill:#565d66}
.plot .title{font-weight:700;font-size:14.5px}.plot .name{font-weight:700;font-size:13.5px;fill:currentColor}
.plot .halo{stroke:#fff;stroke-width:4px;stroke-linejoin:round;fill:none}
.plot .grid{stroke:#e4e7eb;fill:none}.plot .frame{stroke:#9aa1ab;fill:none}
.plot .target{stroke:#16191d;stroke-width:1.3;stroke-dasharray:6 4;fill:none}
.plot .standing{stroke:#565d66;stroke-width:1.3;stroke-dasharray:2 4;fill:none}
.plot .whisker{stroke:currentColor;stroke-width:1.2;fill:none}
.plot .best{stroke:#dfe4ea;stroke-width:13;stroke-linejoin:round;stroke-linecap:round;fill:none}
.plot .line{stroke:currentColor;stroke-width:2.2;stroke-linejoin:round;fill:none}
.plot .dot{fill:currentColor}.plot .faint{fill:currentColor;opacity:.32}
.plot .hollow,.plot .ring{stroke:currentColor;stroke-width:1.6;fill:none}
.plot .drop{stroke:currentColor;stroke-width:1.2;stroke-dasharray:2 3;fill:none}
.plot .s0{color:#6b727c}.plot .s1{color:#0067a8}.plot .s2{color:#c2500a}
.plot .s3{color:#007a5a}.plot .s4{color:#a03d86}.plot .s5{color:#7d6200}
@media (prefers-color-scheme:dark){.plot .paper{fill:#14171b}.plot .ink{fill:#eceff3}.plot .muted{fill:#a9b1bb}
.plot .halo{stroke:#14171b}.plot .grid{stroke:#282d34}.plot .frame{stroke:#5a626d}.plot .target{stroke:#eceff3}.plot .standing{stroke:#a9b1bb}
.plot .best{stroke:#2b323b}.plot .s0{color:#a3abb6}.plot .s1{color:#5ab4ee}.plot .s2{color:#f39a5b}
.plot .s3{color:#3fcf9f}.plot .s4{color:#e58fc8}.plot .s5{color:#e3c23c}}
)";
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += c;
        }
    }
    return result;
}

std::string draw(const Plot& plot, Style style) {
    const Axes axes = axesFor(plot);
    std::string svg =
        fmt::format("<svg class=\"plot\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" "
                    "role=\"img\" aria-label=\"{}\">\n",
                    plotWidth, plotHeight, escaped(plot.title));
    if (style == Style::own) svg += "<style>" + plotStyle() + "</style>\n";
    svg += fmt::format("<rect class=\"paper\" width=\"{}\" height=\"{}\"/>\n", plotWidth, plotHeight);
    svg += fmt::format("<text class=\"ink title\" x=\"{}\" y=\"22\">{}</text>\n", axes.box.left,
                       escaped(plot.title));
    svg += bestOfAll(plot, axes) + drawAxes(axes, plot.xLabel);
    LabelPlacer placer(axes.box);
    const double target = axes.y(axes.target);
    if (plot.kind == PlotKind::precision)
        placer.avoid({{axes.box.left, target}, {axes.box.right, target}}, nobody);
    if (plot.standing > 0) {
        const double y = axes.y(plot.standing);
        placer.avoid({{axes.box.left, y}, {axes.box.right, y}}, nobody);
        placer.avoidText(standingText, {axes.box.left + 6, y - 5});
    }
    for (const PlotCurve& curve : plot.curves) {
        svg += draw(curve, axes);
        placer.avoid(frontOf(curve, axes), curve.slot);
        avoidMarks(placer, curve, axes);
    }
    for (const PlotCurve& curve : plot.curves) {
        const std::vector<Spot> front = frontOf(curve, axes);
        if (front.empty()) continue;
        const Label label = placer.place(curve.label, front, curve.slot);
        for (const char* kind : {"halo", "name"})
            svg += fmt::format("<text class=\"s{} {}\" x=\"{:.1f}\" y=\"{:.1f}\" font-weight=\"700\" "
                               "font-size=\"13.5\">{}</text>\n",
                               curve.slot % 6, kind, label.x, label.y, escaped(curve.label));
    }
    return svg + "</svg>\n";
}

} // namespace sinew::tools::study
