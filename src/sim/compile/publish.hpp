// The end of a step: copies the state to the public buffers, or undoes the step.
#pragma once

#include "sim/model/state.hpp"

namespace sinew::sim {

/// Appends the check that the state is finite, the copy into program().positions and, if that buffer exists,
/// velocities, and the same for buffers that solvers remember. The public buffers hold the last finite state.
void addPublishing(ProgramBuilder& program, const ParticleBuffers& particles);

} // namespace sinew::sim
