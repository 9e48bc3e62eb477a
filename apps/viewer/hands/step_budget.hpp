// Steps before a picture where a device cannot keep up with real time: hands need pictures first.
#pragma once

#include <cstdint>

namespace sinew::viewer {

/// Knows what a step and the rest of a picture take of late.
class StepBudget {
public:
    static constexpr double goal =
        0.05; ///< [s] a picture is allowed when more than one step is taken before it

    /// A step, on the device [s].
    void stepTimed(double seconds);
    /// From one picture to the next [s], with `steps` between them.
    void pictureTaken(double seconds, std::uint32_t steps);

    /// As many as leave a picture within the goal, at least one; `most` where nothing has been timed.
    std::uint32_t steps(std::uint32_t most) const;

private:
    double step_ = 0, rest_ = 0; // [s]; 0 = not known
};

} // namespace sinew::viewer
