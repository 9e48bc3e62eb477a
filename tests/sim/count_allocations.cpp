// The replaced operators and their counter.
#include "sim/count_allocations.hpp"

#include <cstdlib>
#include <new>

#ifdef __has_feature // the macro of clang
#define HAS_FEATURE(name) __has_feature(name)
#else
#define HAS_FEATURE(name) 0
#endif

namespace {

thread_local bool isCounting = false;
thread_local std::size_t allocations = 0;

} // namespace

#if defined __SANITIZE_ADDRESS__ || HAS_FEATURE(address_sanitizer)

// The validation layer keeps memory until the process ends. The same function is in support/device.cpp, which
// is not linked here.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
    return "detect_leaks=0";
}

bool sinew::test::canCountAllocations() {
    return false;
}

#else

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

bool sinew::test::canCountAllocations() {
    return true;
}

#endif

std::size_t sinew::test::countAllocations(const std::function<void()>& action) {
    allocations = 0;
    isCounting = true;
    action();
    isCounting = false;
    return allocations;
}
