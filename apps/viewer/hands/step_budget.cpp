// Running means.
#include "viewer/hands/step_budget.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::viewer {

namespace {

constexpr double newest = 0.25; // share of the newest value in a mean

double mean(double before, double value) {
    return before == 0 ? value : before + newest * (value - before);
}

} // namespace

void StepBudget::stepTimed(double seconds) {
    step_ = mean(step_, seconds);
}

void StepBudget::pictureTaken(double seconds, std::uint32_t steps) {
    rest_ = mean(rest_, std::max(seconds - steps * step_, 0.0));
}

std::uint32_t StepBudget::steps(std::uint32_t most) const {
    if (step_ <= 0) return most;
    const double affordable = std::floor((goal - rest_) / step_);
    return static_cast<std::uint32_t>(std::clamp(affordable, 1.0, static_cast<double>(std::max(most, 1u))));
}

} // namespace sinew::viewer
