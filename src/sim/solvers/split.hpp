// `split`: stiffness-clamped, mass-split Jacobi, one gather pass and one barrier a substep (methods: D). The
// default.
#pragma once

#include "sim/compile.hpp"

namespace sinew::sim::solvers::split {

/// The w of the state's positions, which hold x + theta h v: kappa = omega / (2 n w) [kg], the clamp of a
/// particle's n links.
std::vector<float> positionW(const Scene& scene, const Settings& settings);

void addPasses(ProgramBuilder& program, const Scene& scene, const Settings& settings,
               const ParticleBuffers& particles);

} // namespace sinew::sim::solvers::split
