// `gauss_seidel`: coloured XPBD in place, color by color, with a guarded warm start (methods: D). Few sweeps,
// many barriers: for bodies so large that a device is bound by bandwidth, and for accuracy.
#pragma once

#include "sim/compile.hpp"

namespace sinew::sim::solvers::gaussSeidel {

/// The state is in the order of the scene, with at least one slot that never moves behind it: what pads a
/// color. The w of its positions is inverse mass [1/kg].
SolverPlan plan(const Scene& scene, const Settings& settings, const std::vector<float>& inverseMass);

} // namespace sinew::sim::solvers::gaussSeidel
