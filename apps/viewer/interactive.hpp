// The scene in a window.
#pragma once

#include "viewer/options.hpp"

#include <atomic>

namespace sinew::viewer {

/// Shows the scene until the window is closed; returns the exit code. `messages` counts validation messages
/// and must outlive the call. Throws app::Failure and what scenes and devices throw.
int runInteractive(const Options& options, std::atomic<std::size_t>& messages);

} // namespace sinew::viewer
