// The replaced operators and their counter.
#include "sim/count_allocations.hpp"

#include <cstdlib>
#include <new>

namespace {

thread_local bool isCounting = false;
thread_local std::size_t allocations = 0;

} // namespace

void* operator new(std::size_t size) {
    if (isCounting) ++allocations;
    if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}

void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace sinew::test {

std::size_t countAllocations(const std::function<void()>& action) {
    allocations = 0;
    isCounting = true;
    action();
    isCounting = false;
    return allocations;
}

} // namespace sinew::test
