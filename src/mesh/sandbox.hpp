// Runs a function in a forked child process that cannot harm its parent: limited memory, CPU and wall-clock
// time, no core file, no new file descriptor (so it can open nothing); the answer returns through a pipe.
// Linux.
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

namespace sinew::mesh {

struct ChildLimits {
    std::uint64_t addressSpaceBytes = 1ull << 30; ///< beyond what the parent has mapped
    std::uint64_t answerBytes = 1ull << 30;
    double cpuSeconds = 3, wallSeconds = 10;
};

/// Reason for a missing answer, as the middle of a sentence: "it crashed (signal 11)".
class ChildFailure : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Returns the result of `work` in the child, or throws ChildFailure. Never hangs, leaves no zombie and no
/// descriptor. `work` may use memory and CPU freely but must not rely on other threads of the parent, open
/// files, or print.
std::string runInChild(const std::function<std::string()>& work, const ChildLimits& limits);

} // namespace sinew::mesh
