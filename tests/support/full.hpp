// Whether tests run in their longer form (SINEW_FULL=1), which has more cases of the same kind.
#pragma once

#include <cstdlib>

namespace sinew::test {

inline bool isFull() {
    return std::getenv("SINEW_FULL") != nullptr;
}

} // namespace sinew::test
