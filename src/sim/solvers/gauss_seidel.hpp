// `gauss_seidel`: graph-coloured XPBD [Macklin 2016] in place, color by color, with a guarded warm start. It
// has few sweeps but many barriers: for bodies so large that the device is limited by bandwidth, and for
// accuracy.
#pragma once

#include "sim/solvers/solver_plan.hpp"
#include "sinew/scene.hpp"

namespace sinew::sim::solvers::gaussSeidel {

/// The state is in the order of the scene, followed by at least one slot that never moves, for padding
/// colors. The w of positions is inverse mass [1/kg].
SolverPlan plan(const SceneModel& model);

} // namespace sinew::sim::solvers::gaussSeidel
