// Lengths as people say them.
#pragma once

#include <array>
#include <string>

namespace sinew::viewer {

/// A length [m] with at most three digits, in a unit between micrometers and kilometers: "2.54 cm", "0 cm".
std::string lengthText(float meters);

/// A point [m] as three numbers in one unit, that of the largest: "12.3, 0, -4.5 cm".
std::string pointText(const std::array<float, 3>& meters);

/// The largest of 1, 2 and 5 times a power of ten that is at most `most` [m], with tolerance for rounding; 0
/// unless `most` is positive and finite.
float roundLength(float most);

} // namespace sinew::viewer
