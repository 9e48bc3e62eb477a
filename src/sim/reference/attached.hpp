// Bends, internal damping, attachments and tethers, as the sequential solvers share them.
#pragma once

#include "sim/reference/problem.hpp"

namespace sinew::sim::reference {

/// C = x_a - 2 x_b + x_c.
Eigen::Vector3d bendOf(const Bend& bend, const std::vector<Eigen::Vector3d>& x);

/// Adds the forces [N] of bends at the positions `y`, as stiff as `split` permits with kicks of length h.
void addBendForces(const Problem& problem, double omega, double theta, double h,
                   const std::vector<Eigen::Vector3d>& y, std::vector<Eigen::Vector3d>& force);

/// Ratio of the largest damping coefficient x h [kg] of a link of `split` to the clamp of its stiffness x h^2
/// [kg]. Stability requires s (1 + 2 theta) + 2 d <= 4 for the Rayleigh quotients s and d of stiffness and
/// damping; 5 % are held in reserve. `mostOfLinks`: largest k_c D_c / omega.
double dampingShare(const Problem& problem, double mostOfLinks, double omega, double theta, double h);

/// The end of a substep: attached particles move to their points, which have moved by `fraction` of this
/// step's way; then tethered particles move within reach of their anchors. Changes positions only; the caller
/// adds dx / h to the velocity for a correction dx.
void pullAttached(const Problem& problem, double h, double dt, double fraction, State& state);

/// Ends a step: the points stay at their final positions.
void settleAnchors(const Problem& problem, double dt, State& state);

} // namespace sinew::sim::reference
