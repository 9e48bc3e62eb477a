// What the sequential solvers share of bends, internal damping, attachments and tethers (methods: B, D).
#pragma once

#include "sim/reference/problem.hpp"

namespace sinew::sim::reference {

/// C = x_a - 2 x_b + x_c.
Eigen::Vector3d bendOf(const Bend& bend, const std::vector<Eigen::Vector3d>& x);

/// Adds the forces [N] of bends at the positions `y`, as stiff as `split` lets them be in kicks as long as h.
void addBendForces(const Problem& problem, double omega, double theta, double h,
                   const std::vector<Eigen::Vector3d>& y, std::vector<Eigen::Vector3d>& force);

/// `mostOfLinks`: largest k_c D_c / omega. The largest damping coefficient x h [kg] of a link of `split`,
/// over the clamp of its stiffness x h^2 [kg]: what stability leaves, s (1 + 2 theta) + 2 d <= 4, of which 5
/// % are kept back.
double dampingShare(const Problem& problem, double mostOfLinks, double omega, double theta, double h);

/// The end of a substep: attached particles go to their points, which have gone `fraction` of this step's
/// way, then tethered ones to where their tethers reach. Positions only: a correction dx is worth dx / h of
/// velocity.
void pullAttached(const Problem& problem, double h, double dt, double fraction, State& state);

/// Ends a step: the points stay where they came to.
void settleAnchors(const Problem& problem, double dt, State& state);

} // namespace sinew::sim::reference
