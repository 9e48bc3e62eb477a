// The end of a step: the public copy of the state, or the step undone.
#pragma once

#include "sim/compile.hpp"

namespace sinew::sim::publish {

/// Adds the check that the state is finite, the copy into program().positions and, where that is a buffer,
/// velocities, and the same for what solvers remember. Public copies hold the last finite state.
void addPasses(ProgramBuilder& program, const ParticleBuffers& particles);

} // namespace sinew::sim::publish
