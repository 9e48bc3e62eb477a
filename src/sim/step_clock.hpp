// Turns frames of any length into steps of one length, so that h never changes: the stretch of a loaded link
// that a solver leaves depends on h, and a body at rest would tremble with the frame rate.
#pragma once

#include <cstdint>

namespace sinew::sim {

/// One clock a simulation. Never throws.
class StepClock {
public:
    /// Steps of `dt` [s], at most `mostSteps` a frame, or a slow device would fall behind without end.
    StepClock(double dt, std::uint32_t mostSteps) : dt_(dt), mostSteps_(mostSteps) {}

    struct Due {
        std::uint32_t steps = 0; ///< to record now
        double ahead = 0;        ///< share of a step that has begun [0, 1): to draw between two states
        double lostTime = 0;     ///< what the limit dropped [s]
    };
    /// `frameTime` [s] has passed; what is negative or no number is no time.
    Due advance(double frameTime) noexcept;

private:
    double dt_;
    std::uint32_t mostSteps_;
    double waiting_ = 0; // [s], less than dt_ between calls
};

} // namespace sinew::sim
