// Whether tests run in their longer form (SINEW_FULL=1), which has more cases of the same kind, and whether
// they run without the validation layer (SINEW_UNVALIDATED=1), for platforms that have none.
#pragma once

#include <cstdlib>

namespace sinew::test {

inline bool isFull() {
    return std::getenv("SINEW_FULL") != nullptr;
}

inline bool isUnvalidated() {
    return std::getenv("SINEW_UNVALIDATED") != nullptr;
}

} // namespace sinew::test
