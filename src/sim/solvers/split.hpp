// `split`: stiffness-clamped, mass-split Jacobi, one gather and one barrier a substep (methods: D). The
// default.
#pragma once

#include "sim/compile.hpp"

namespace sinew::sim::solvers::split {

/// Free particles and bodies whose links are listed come first, in the order of the scene; then a dense box
/// for each body on a grid (lattice/placement.hpp).
StateLayout layoutState(const Scene& scene, const Settings& settings);

/// The w of the state's positions, which hold x + theta h v: tau [s^2], which clamps a particle's links
/// (solvers/shares.hpp).
std::vector<float> positionW(const Scene& scene, const Settings& settings);

void addPasses(ProgramBuilder& program, const Scene& scene, const Settings& settings,
               const ParticleBuffers& particles);

} // namespace sinew::sim::solvers::split
