// The threads of a software device: lavapipe reads LP_NUM_THREADS when an instance is made, so that devices
// with and without threads can stand in one process.
#pragma once

#include <optional>
#include <string>

namespace sinew::app {

/// The variable's name.
inline constexpr const char* driverThreadsVariable = "LP_NUM_THREADS";

/// Instances that are made while this lives compute on the thread that submits to them. Sets the variable to
/// 0 and restores it at the end: no other thread may read or write the environment meanwhile, except where
/// the variable exists already, when only its value is swapped.
class WithoutDriverThreads {
public:
    WithoutDriverThreads();
    ~WithoutDriverThreads();
    WithoutDriverThreads(const WithoutDriverThreads&) = delete;
    WithoutDriverThreads& operator=(const WithoutDriverThreads&) = delete;

private:
    std::optional<std::string> before_;
};

} // namespace sinew::app
