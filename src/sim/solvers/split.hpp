// `split`: stiffness-clamped, mass-split Jacobi with one gather and one barrier a substep; the default
// solver. shares.hpp says why it is stable.
#pragma once

#include "sim/solvers/solver_plan.hpp"
#include "sinew/scene.hpp"

namespace sinew::sim::solvers::split {

/// Free particles and bodies with listed links come first, in the order of the scene, then a dense box for
/// each body on a grid (lattice/placement.hpp). Positions hold x + theta h v and in w tau [s^2], which clamps
/// a particle's links (solvers/shares.hpp).
SolverPlan plan(const SceneModel& model);

/// Whether the links of a substep leave predicted positions, x: if something touches or forces are kept,
/// further passes end the substep.
bool contactsFollow(const Scene& scene, const Settings& settings);

} // namespace sinew::sim::solvers::split
