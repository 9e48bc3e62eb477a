// How `split` divides a particle among its distance constraints. A constraint's share of particle i is
// k~_c / sum_c k~_c: any positive k~ is stable (methods: D), a good one lets every constraint reach its clamp
// at about the same substep. k~ is the stiffness, levelled off where a substep cannot follow it anyway:
//
//   k~_c = k_c / (1 + 2 w h^2 K_c),   K_c = k_c; in a grid, the stiffest constraint of the grid that has the
//                                     same rest length; w the mean inverse mass, h the scene's dt / substeps
//
// so that constraints that a substep cannot follow do not take everything (a soft one beside one a million
// times stiffer keeps its stiffness), and links of one kind in a grid keep their ratio (kernels then need one
// factor a kind).
#pragma once

#include "sim/scene.hpp"

#include <span>
#include <vector>

namespace sinew::sim::solvers {

/// Stiffness of a constraint [N/m]. A rigid one gets 1e20: the clamp takes over long before, and padding must
/// give 0, not Inf x 0.
float stiffnessOf(float compliance);

/// k~ of every distance constraint of the scene [N/m]; 0 where neither end moves.
std::vector<float> shareStiffness(const Scene& scene, const Settings& settings,
                                  std::span<const float> inverseMass);

/// tau = omega / (2 w sum k~) of every particle [s^2]: a constraint is clamped to k~ min(tau_a, tau_b) / h^2.
/// Large where a particle never moves or has no constraint.
std::vector<float> clampTimes(const Scene& scene, const Settings& settings,
                              std::span<const float> inverseMass, std::span<const float> shares);

} // namespace sinew::sim::solvers
