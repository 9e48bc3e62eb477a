// The interactive viewer: the scene in a window.
#pragma once

#include "viewer/jobs/options.hpp"

#include <atomic>

namespace sinew::viewer {

/// Shows the scene until the window is closed; returns the exit code. `messages` counts validation messages
/// and must outlive the call. Throws app::Failure and the exceptions of scenes and devices.
int runInteractive(const Options& options, std::atomic<std::size_t>& messages);

} // namespace sinew::viewer
