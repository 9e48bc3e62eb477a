// Numbers in cures: rounded to the side on which they help.
#pragma once

#include <string>

namespace sinew::scenes {

/// With three digits, rounded up: what is so much larger is large enough.
std::string atLeast(double value);
/// With two digits, rounded down: what is so small is small enough.
std::string atMost(double value);

} // namespace sinew::scenes
