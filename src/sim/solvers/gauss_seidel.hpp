// `gauss_seidel`: coloured XPBD in place, color by color, with a guarded warm start (methods: D). Few sweeps,
// many barriers: for bodies so large that a device is bound by bandwidth, and for accuracy.
#pragma once

#include "sim/compile.hpp"

namespace sinew::sim::solvers::gaussSeidel {

/// In the order of the scene, with at least one slot that never moves behind it: what pads a color.
StateLayout layoutState(const Scene& scene, const Settings& settings);

/// The w of the state's positions: inverse mass [1/kg].
std::vector<float> positionW(const Scene& scene, const Settings& settings);

void addPasses(ProgramBuilder& program, const Scene& scene, const Settings& settings,
               const ParticleBuffers& particles);

} // namespace sinew::sim::solvers::gaussSeidel
