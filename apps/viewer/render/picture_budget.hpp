// Budget of a picture on devices slower than real time: limits the steps before a picture and the pixels in
// it, so that input is answered.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sinew::viewer {

/// Estimates from recent pictures the time of a step and of the rest of a picture.
class PictureBudget {
public:
    static constexpr double goal = 0.05; ///< time of a picture [s]
    /// Ratios of sides of the drawn image, by scale(). Enlarging costs a software device half of what a
    /// quarter of the pixels saves; no scale in between pays.
    static constexpr std::array<float, 2> scales{1, 0.5f};

    /// GPU time of a step [s].
    void stepTimed(double seconds);
    /// Time from one picture to the next [s], with `steps` between them.
    void pictureTaken(double seconds, std::uint32_t steps);

    /// Number of steps that keep a picture within the goal, at least one; `most` if nothing was timed yet.
    std::uint32_t steps(std::uint32_t most) const;

    /// Index into `scales`: smaller pictures if the goal is missed, and not because of the step alone.
    std::size_t scale() const noexcept { return scale_; }

private:
    void chooseScale();
    double step_ = 0, rest_ = 0; // [s]; 0 = not known
    std::size_t scale_ = 0;
    std::uint32_t pictures_ = 0; // at this scale
};

} // namespace sinew::viewer
