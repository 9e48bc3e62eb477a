// Counts calls of operator new. Replaces the global operators of the binary that links it, in a file of its
// own so that no compiler inlines one of the pair.
#pragma once

#include <cstddef>
#include <functional>

namespace sinew::test {

/// False under AddressSanitizer, which needs the operators for itself.
bool canCountAllocations();

/// Calls of operator new in this thread while `action` runs.
std::size_t countAllocations(const std::function<void()>& action);

} // namespace sinew::test
