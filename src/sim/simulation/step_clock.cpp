// The time accumulator of StepClock.
#include "sim/simulation/step_clock.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim {

StepClock::Due StepClock::advance(double frameTime) noexcept {
    Due due;
    if (frameTime > 0) waiting_ += std::min(frameTime, 1e9);
    // The tolerance makes a frame as long as a step give one step: sums of rounded times must not skip a
    // step.
    const double whole = std::floor(waiting_ / dt_ + 1e-6);
    due.steps = static_cast<std::uint32_t>(std::min(whole, static_cast<double>(mostSteps_)));
    due.lostTime = (whole - due.steps) * dt_;
    waiting_ = std::max(0.0, waiting_ - whole * dt_);
    due.ahead = waiting_ / dt_;
    return due;
}

} // namespace sinew::sim
