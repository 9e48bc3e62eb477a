// Sorts the values when a quantile is requested.
#include "viewer/ui/frame_times.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace sinew::viewer {

namespace {

constexpr std::array<std::string_view, static_cast<std::size_t>(FrameTimes::Kind::count)> names{
    "frame [ms]",
    "frame in a cut [ms]",
    "thread of the window [ms of processor time]",
    "step, on the device [ms]",
    "drawing, on the device [ms]",
    "panels, on the device [ms]",
    "input to picture, at most [ms]",
    "input to picture [pictures without it]"};

} // namespace

void FrameTimes::add(Kind kind, double value) {
    Values& values = values_[static_cast<std::size_t>(kind)];
    if (values.newest.size() < most)
        values.newest.push_back(static_cast<float>(value));
    else
        values.newest[values.total % most] = static_cast<float>(value);
    values.largest = values.total == 0 ? value : std::max(values.largest, value);
    values.sum += value;
    ++values.total;
}

void FrameTimes::addFrame(double ms, bool isOfCut) {
    add(Kind::frame, ms);
    if (isOfCut) add(Kind::frameOfCut, ms);
    if (ms <= tooLong) return;
    ++slow_;
    if (isOfCut) ++slowOfCut_;
}

void FrameTimes::clear() {
    *this = {};
}

double FrameTimes::quantile(Kind kind, double share) const {
    std::vector<float> sorted = of(kind).newest;
    if (sorted.empty()) return 0;
    const double rank = std::ceil(share * static_cast<double>(sorted.size())) - 1;
    const auto at =
        static_cast<std::ptrdiff_t>(std::clamp(rank, 0.0, static_cast<double>(sorted.size() - 1)));
    std::ranges::nth_element(sorted, sorted.begin() + at);
    return double{sorted[static_cast<std::size_t>(at)]};
}

double FrameTimes::framesPerSecond() const {
    const Values& frames = of(Kind::frame);
    return frames.sum > 0 ? 1000 * static_cast<double>(frames.total) / frames.sum : 0;
}

std::string FrameTimes::line(Kind kind) const {
    char text[160];
    std::snprintf(text, sizeof text, "  %-44s%8zu%10.2f%10.2f%10.2f\n",
                  names[static_cast<std::size_t>(kind)].data(), of(kind).total, quantile(kind, 0.5),
                  quantile(kind, 0.95), of(kind).largest);
    return text;
}

std::string FrameTimes::table() const {
    char head[160], foot[200];
    std::snprintf(head, sizeof head, "frame times: %.1f pictures a second\n  %-44s%8s%10s%10s%10s\n",
                  framesPerSecond(), "", "count", "p50", "p95", "max");
    std::string text = head;
    for (std::size_t kind = 0; kind < values_.size(); ++kind)
        if (values_[kind].total > 0) text += line(static_cast<Kind>(kind));
    std::snprintf(foot, sizeof foot,
                  "  frames over %.0f ms: %zu, in a cut: %zu\n"
                  "  pipelines made while keys waited: %zu\n",
                  tooLong, slow_, slowOfCut_, pipelines_);
    return text + foot;
}

std::string FrameTimes::summary() const {
    char text[120];
    std::snprintf(text, sizeof text, "%.1f pictures a second, %.0f ms each (p50), %.0f ms at most",
                  framesPerSecond(), quantile(Kind::frame, 0.5), of(Kind::frame).largest);
    return text;
}

} // namespace sinew::viewer
