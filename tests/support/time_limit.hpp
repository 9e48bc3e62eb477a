// The processor time of a piece of code, for tests that hold it to its growth, such as linear and not
// quadratic. Other programs that run at once do not count, and a sanitized build has more time.
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
/// How many times as long as without a sanitizer code may take.
inline constexpr double slowness = 5;
#else
inline constexpr double slowness = 1;
#endif
#undef SINEW_HAS_FEATURE

/// The processor time of the process since this was made, divided by slowness.
class ProcessorTime {
public:
    [[nodiscard]] double seconds() const {
        return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC / slowness;
    }

private:
    std::clock_t start_ = std::clock();
};

} // namespace sinew::test
