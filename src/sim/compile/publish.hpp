// The end of a step: copies the state to the public buffers, or undoes the step.
#pragma once

#include "sim/model/feature.hpp"

namespace sinew::sim {

/// Appends the check that the state is finite, the passes of features that depend on it, the copy into
/// program().positions and, if that buffer exists, velocities, and the same for buffers that solvers
/// remember. The public buffers hold the last finite state.
void addPublishing(Build& build);

} // namespace sinew::sim
