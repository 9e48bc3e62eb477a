// Times of frames without a window: the same table as in the window, as far as it applies.
#pragma once

#include "sinew/vk/timestamps.hpp"
#include "viewer/document/document.hpp"
#include "viewer/ui/frame_times.hpp"

#include <chrono>
#include <optional>
#include <vector>

namespace sinew::viewer {

/// One thread; must not outlive the device.
class HeadlessTimes {
public:
    HeadlessTimes(const vk::Device& device, const Document& document);
    /// Call after the document changed its simulation, before its first step is recorded.
    void restart(const Document& document);

    /// For the commands of a step; at most framesInFlight steps are in flight.
    vk::Timestamps* ofStep(std::uint64_t frame) { return &steps_[frame % steps_.size()]; }
    void stepFinished(std::uint64_t frame);

    void beginDrawing(VkCommandBuffer commands);
    void endDrawing(VkCommandBuffer commands);
    void pictureFinished();

    /// Call after the next frame was submitted.
    void submitted();

    std::string table() const { return times_.table(); }

private:
    const vk::Device& device_;
    std::vector<vk::Timestamps> steps_;
    vk::Timestamps drawing_;
    FrameTimes times_;
    std::optional<std::chrono::steady_clock::time_point> last_;
};

} // namespace sinew::viewer
