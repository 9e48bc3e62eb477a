// Headless runs: pictures without a window, by steps instead of time, so that they do not depend on speed.
#pragma once

#include "viewer/jobs/options.hpp"

#include <atomic>

namespace sinew::viewer {

/// Simulates and draws as the options say; returns the exit code. `messages` counts validation messages and
/// must outlive the call. Throws app::Failure and the exceptions of scenes, devices and files.
int runHeadless(const Options& options, std::atomic<std::size_t>& messages);

} // namespace sinew::viewer
