// Checks of contacts that keep the distance that they have when the scene is loaded.
#pragma once

#include "sim/runner.hpp"

#include <string>

namespace sinew::test {

/// The longest way of a particle from its place in the scene [m].
double moved(const std::vector<Eigen::Vector3d>& x, const sim::Scene& scene);

/// Without contacts bodies tremble by rounding. With those that keep their rest distance they do as well:
/// after `steps` nobody is elsewhere than without contacts by 1e-4 of `radius` [m], or has a tenth more
/// energy.
void expectStill(const sim::Scene& scene, const sim::Settings& settings, double radius, int steps,
                 const std::string& what);

/// After twice `steps` the state has the same bits with an undone step on the way, from a saved state, in a
/// simulation with more room that took over, and after a reset.
void expectRemembered(const sim::Scene& scene, const sim::Settings& settings, int steps);

} // namespace sinew::test
