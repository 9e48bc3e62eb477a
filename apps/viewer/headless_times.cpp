// Reads timestamps.
#include "viewer/headless_times.hpp"

#include <numeric>
#include <utility>

namespace sinew::viewer {

HeadlessTimes::HeadlessTimes(const vk::Device& device, const Document& document)
    : device_(device), drawing_(device, 1) {
    restart(document);
}

void HeadlessTimes::restart(const Document& document) {
    steps_.clear();
    const auto spans = static_cast<std::uint32_t>(document.simulation().phases().size());
    for (std::uint32_t slot = 0; slot < sim::Simulation::framesInFlight; ++slot)
        steps_.emplace_back(device_, spans);
}

void HeadlessTimes::stepFinished(std::uint64_t frame) {
    const std::vector<double> phases = ofStep(frame)->milliseconds();
    if (!phases.empty())
        times_.add(FrameTimes::Kind::step, std::accumulate(phases.begin(), phases.end(), 0.0));
}

void HeadlessTimes::beginDrawing(VkCommandBuffer buffer) {
    vk::Commands commands(device_, buffer);
    drawing_.reset(commands);
    drawing_.begin(commands, 0);
}

void HeadlessTimes::endDrawing(VkCommandBuffer buffer) {
    vk::Commands commands(device_, buffer);
    drawing_.end(commands, 0);
}

void HeadlessTimes::pictureFinished() {
    for (const double ms : drawing_.milliseconds()) times_.add(FrameTimes::Kind::drawing, ms);
}

void HeadlessTimes::submitted() {
    const auto now = std::chrono::steady_clock::now();
    const auto last = std::exchange(last_, now);
    if (last) times_.addFrame(std::chrono::duration<double, std::milli>(now - *last).count(), false);
}

} // namespace sinew::viewer
