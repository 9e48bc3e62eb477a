// Estimates by running means.
#include "viewer/render/picture_budget.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::viewer {

namespace {

constexpr double newest = 0.25; // weight of the newest value in a mean
constexpr std::uint32_t fewestPictures =
    6;                          // between changes of scale: the first picture of a scale is untypical
constexpr double cheap = 0.02;  // [s] besides steps: fewer pixels would save little
constexpr double reserve = 0.8; // of either limit, before pixels increase again

double mean(double before, double value) {
    return before == 0 ? value : before + newest * (value - before);
}

} // namespace

void PictureBudget::stepTimed(double seconds) {
    step_ = mean(step_, seconds);
}

void PictureBudget::pictureTaken(double seconds, std::uint32_t steps) {
    ++pictures_;
    if (pictures_ > 1) rest_ = mean(rest_, std::max(seconds - steps * step_, 0.0));
    if (pictures_ >= fewestPictures) chooseScale();
}

std::uint32_t PictureBudget::steps(std::uint32_t most) const {
    if (step_ <= 0) return most;
    const double affordable = std::floor((goal - rest_) / step_);
    return static_cast<std::uint32_t>(std::clamp(affordable, 1.0, static_cast<double>(std::max(most, 1u))));
}

// With four times the pixels, the rest of a picture takes at most four times as long.
void PictureBudget::chooseScale() {
    const std::size_t before = scale_;
    const double larger = 4 * rest_;
    if (step_ + rest_ > goal && rest_ > cheap)
        scale_ = std::min(scale_ + 1, scales.size() - 1);
    else if (scale_ > 0 && (step_ + larger < reserve * goal || larger < reserve * cheap))
        --scale_;
    if (scale_ == before) return;
    rest_ = 0;
    pictures_ = 0;
}

} // namespace sinew::viewer
