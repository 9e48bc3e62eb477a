// Checks of contacts that keep their distance at load as their rest distance.
#pragma once

#include "sim/runner.hpp"

#include <string>

namespace sinew::test {

/// Largest displacement of a particle from its place in the scene [m].
double moved(const std::vector<Eigen::Vector3d>& x, const sim::Scene& scene);

/// Compares with the same scene without contacts, where bodies tremble by rounding. After `steps`, the
/// positions may differ by 1e-4 of `radius` [m], and the energy may be a tenth larger.
void expectStill(const sim::Scene& scene, const sim::Settings& settings, double radius, int steps,
                 const std::string& what);

/// Expects equal bits after twice `steps` with an undone step on the way, from a saved state, in a simulation
/// with larger capacity that takes over, and after a reset.
void expectRemembered(const sim::Scene& scene, const sim::Settings& settings, int steps);

} // namespace sinew::test
