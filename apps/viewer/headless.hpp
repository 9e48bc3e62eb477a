// Pictures without a window: stepped, not timed, so that they are the same at any speed.
#pragma once

#include "viewer/options.hpp"

#include <atomic>

namespace sinew::viewer {

/// Simulates and draws what the options ask for; returns the exit code. `messages` counts validation messages
/// and must outlive the call. Throws app::Failure and what scenes, devices and files throw.
int runHeadless(const Options& options, std::atomic<std::size_t>& messages);

} // namespace sinew::viewer
