// Powers of ten, and steps of them.
#include "scenes/sentences.hpp"

#include <cmath>
#include <cstdio>

namespace sinew::scenes {

namespace {

/// The last of so many digits of a value above 0.
double lastDigit(double value, int digits) {
    return std::pow(10, std::floor(std::log10(value)) - (digits - 1));
}

std::string shortText(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

} // namespace

std::string atLeast(double value) {
    if (!(value > 0)) return "0";
    const double digit = lastDigit(value, 3);
    return shortText(std::ceil(value / digit - 1e-9) * digit);
}

std::string atMost(double value) {
    if (!(value > 0)) return "0";
    const double digit = lastDigit(value, 2);
    return shortText(std::floor(value / digit + 1e-6) *
                     digit); // a float32 that stands for two digits has them
}

} // namespace sinew::scenes
