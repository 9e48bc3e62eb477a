// What frames without a window cost: the same table as that of the window, as far as there is such a thing.
#pragma once

#include "viewer/draw/stage.hpp"
#include "viewer/window/frame_times.hpp"
#include "vk/timestamps.hpp"

#include <chrono>
#include <optional>
#include <vector>

namespace sinew::viewer {

/// One thread; must not outlive the device.
class HeadlessTimes {
public:
    HeadlessTimes(const vk::Device& device, const Stage& stage);
    /// After the stage has another simulation, of which no step was recorded yet.
    void restart(const Stage& stage);

    /// For the commands of a step, of which framesInFlight at most are on their way.
    vk::Timestamps* ofStep(std::uint64_t frame) { return &steps_[frame % steps_.size()]; }
    void stepFinished(std::uint64_t frame);

    void beginDrawing(VkCommandBuffer commands);
    void endDrawing(VkCommandBuffer commands);
    void pictureFinished();

    /// The next frame was given to the device.
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
