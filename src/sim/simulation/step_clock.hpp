// Turns frames of any length into steps of one length, so that h never changes: the stretch that a solver
// leaves in a loaded link depends on h, and a body at rest would tremble with the frame rate.
#pragma once

#include <cstdint>

namespace sinew::sim {

/// A clock for one simulation. Never throws.
class StepClock {
public:
    /// `dt` is the length of a step [s]; `mostSteps` limits the steps of a frame, without which a slow device
    /// would fall behind ever further.
    StepClock(double dt, std::uint32_t mostSteps) : dt_(dt), mostSteps_(mostSteps) {}

    struct Due {
        std::uint32_t steps = 0; ///< to record now
        double ahead = 0;        ///< elapsed share of the next step [0, 1): to interpolate between two states
        double lostTime = 0;     ///< dropped by the limit [s]
    };
    /// Adds `frameTime` [s]; a negative time or NaN counts as 0.
    Due advance(double frameTime) noexcept;

private:
    double dt_;
    std::uint32_t mostSteps_;
    double waiting_ = 0; // [s], less than dt_ between calls
};

} // namespace sinew::sim
