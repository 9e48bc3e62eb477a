// What a device that cannot keep up with real time does less of, so that hands have pictures: steps before a
// picture, and pixels in it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sinew::viewer {

/// Knows what a step and the rest of a picture take of late.
class PictureBudget {
public:
    static constexpr double goal = 0.05; ///< [s] for a picture
    /// Of the sides of what is drawn, by scale(). To enlarge costs a software device half of what is saved by
    /// a quarter of the pixels: nothing lies between the two.
    static constexpr std::array<float, 2> scales{1, 0.5f};

    /// A step, on the device [s].
    void stepTimed(double seconds);
    /// From one picture to the next [s], with `steps` between them.
    void pictureTaken(double seconds, std::uint32_t steps);

    /// As many as leave a picture within the goal, at least one; `most` where nothing has been timed.
    std::uint32_t steps(std::uint32_t most) const;

    /// Index into `scales`: smaller pictures where the goal is missed and that is not for the step alone.
    std::size_t scale() const noexcept { return scale_; }

private:
    void chooseScale();
    double step_ = 0, rest_ = 0; // [s]; 0 = not known
    std::size_t scale_ = 0;
    std::uint32_t pictures_ = 0; // of this scale
};

} // namespace sinew::viewer
