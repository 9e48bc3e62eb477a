// Processor time of a piece of code, for tests that limit its growth, for example to linear. Excludes other
// programs and allows more time under a sanitizer.
#pragma once

#include <ctime>

namespace sinew::test {

#if defined(__has_feature)
#define SINEW_HAS_FEATURE(feature) __has_feature(feature)
#else
#define SINEW_HAS_FEATURE(feature) 0
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || SINEW_HAS_FEATURE(address_sanitizer) || \
    SINEW_HAS_FEATURE(thread_sanitizer)
/// Factor by which a sanitizer may slow code down.
inline constexpr double slowness = 5;
#else
inline constexpr double slowness = 1;
#endif
#undef SINEW_HAS_FEATURE

/// Processor time of the process since construction, divided by slowness.
class ProcessorTime {
public:
    [[nodiscard]] double seconds() const {
        return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC / slowness;
    }

private:
    std::clock_t start_ = std::clock();
};

} // namespace sinew::test
