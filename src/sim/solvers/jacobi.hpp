// `jacobi`: the slides' weighted Jacobi, the published baseline. A constraint pass writes each correction to
// its own slot of a correction buffer; a particle pass applies the weighted sum. PBD order with the half-kick
// (methods: D).
#pragma once

#include "sim/compile.hpp"

namespace sinew::sim::solvers::jacobi {

/// The w of the state's positions: inverse mass [1/kg].
std::vector<float> positionW(const Scene& scene, const Settings& settings);

void addPasses(ProgramBuilder& program, const Scene& scene, const Settings& settings,
               const ParticleBuffers& particles);

} // namespace sinew::sim::solvers::jacobi
