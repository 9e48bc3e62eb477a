// `jacobi`: weighted Jacobi, the published baseline. A constraint pass writes each correction to its own slot
// of a correction buffer; a particle pass applies the weighted sum. The order of operations is that of PBD,
// with a half kick.
#pragma once

#include "sim/solvers/solver_plan.hpp"
#include "sinew/scene.hpp"

namespace sinew::sim::solvers::jacobi {

/// The state is in the order of the scene; the w of positions is inverse mass [1/kg].
SolverPlan plan(const SceneModel& model);

} // namespace sinew::sim::solvers::jacobi
