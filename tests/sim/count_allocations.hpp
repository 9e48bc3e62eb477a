// Counts calls of operator new. Replaces the global operators of the binary in a separate source file, so
// that no compiler inlines only one of a pair.
#pragma once

#include <cstddef>
#include <functional>

namespace sinew::test {

/// False under AddressSanitizer, which replaces the operators itself.
bool canCountAllocations();

/// Number of calls of operator new in this thread while `action` runs.
std::size_t countAllocations(const std::function<void()>& action);

} // namespace sinew::test
