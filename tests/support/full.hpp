// Tests that have a longer form: more of the same in the same way, for whoever has the time (SINEW_FULL=1).
#pragma once

#include <cstdlib>

namespace sinew::test {

inline bool isFull() {
    return std::getenv("SINEW_FULL") != nullptr;
}

} // namespace sinew::test
