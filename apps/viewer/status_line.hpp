// The window's title: what is shown, where it runs and how fast.
#pragma once

#include "viewer/stage.hpp"

#include <chrono>

namespace sinew::viewer {

class StatusLine {
public:
    StatusLine(const sim::Scene& scene, const vk::Device& device);

    void frameDrawn() { ++frames_; }
    /// GPU time of one step [ms].
    void stepTimed(double milliseconds);

    /// Particles that sleep, and whether a hand holds something.
    void setSleeping(std::uint32_t particles) { sleeping_ = particles; }
    void setHolding(bool isHolding) { isHolding_ = isHolding; }

    /// A new title, twice a second or when what it says about playing has changed.
    std::optional<std::string> title(bool isPaused, bool isDiverged);

private:
    using Clock = std::chrono::steady_clock;
    std::string head_;
    Clock::time_point since_ = Clock::now();
    std::uint64_t frames_ = 0;
    double framesPerSecond_ = 0, stepMs_ = 0; ///< stepMs_: smoothed; 0 = not measured
    std::uint32_t sleeping_ = 0;
    bool isHolding_ = false, wasHolding_ = false;
    bool wasPaused_ = false, wasDiverged_ = false, isFirst_ = true;
};

} // namespace sinew::viewer
