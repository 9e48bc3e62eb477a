// Clocks of the pictures of a window: time of steps and drawing on the device, pictures on their way,
// pipelines that the window's thread has made.
#pragma once

#include "sinew/vk/timestamps.hpp"
#include "viewer/player/player_context.hpp"

namespace sinew::viewer {

/// Main thread only.
class PictureTimes {
public:
    explicit PictureTimes(const PlayerContext& player);

    /// For the first step of a picture.
    vk::Timestamps* ofStep(std::uint32_t slot) noexcept { return &slots_[slot].step; }
    /// Begin and end of the drawing and of the panels of a picture. Recorded only with --timing: each look at
    /// the clock costs a software device a flush.
    enum class Part : std::uint32_t { drawing, panels };
    void begin(const Presenter::Frame& frame, Part part);
    void end(const Presenter::Frame& frame, Part part);
    /// The commands of a picture were submitted. `isCutting`: a step before it cuts. Waits for the first
    /// picture with --timing.
    void submitted(const Presenter::Frame& frame, bool isCutting);
    /// Takes the times of a slot that has finished. Returns those of the phases of its first step [ms], if it
    /// `hasSteps` and the device has a clock.
    std::vector<double> settle(std::uint32_t slot, bool hasSteps);
    /// Tells Session::timing() of pictures that have come; returns how many are on their way.
    std::size_t onTheirWay();
    /// Counts the pipelines that this thread has made since the last call. It is not to make any.
    void countPipelines();
    /// The document has another simulation, which may have other phases.
    void restart();

private:
    struct Slot {
        vk::Timestamps step, drawing;
        bool hasDrawing = false; // of the picture in it
    };
    vk::Timestamps stepTimes() const;

    const PlayerContext& player_;
    std::vector<Slot> slots_;
    std::uint32_t cutFrames_ = 0; // pictures that may still wait for a cut
    std::size_t pipelines_;       // of this thread, that were counted
};

} // namespace sinew::viewer
