// The energy of a scene's springs and cell volumes and what follows from it: forces, a bound on the fastest
// vibration. For R1 and R2, the two references that know equations of motion and not a solver.
#pragma once

#include "sim/reference/problem.hpp"

namespace sinew::sim::reference {

/// Throws std::invalid_argument, in one sentence that names `what` cannot be computed, for a scene with rigid
/// links (which have no energy), bends, attachments, tethers, boundary planes or colliders.
void requireSprings(const Scene& scene, const char* what);
/// The same for a scene with damping, of motion or of links.
void requireUndamped(const Scene& scene, const char* what);

/// Sum of (|x_a - x_b| - restLength)^2 / (2 compliance) and of the energies of cells [J].
double elasticEnergy(const Problem& problem, const std::vector<Eigen::Vector3d>& x);

/// Adds to `force` [N] what springs and cells do to every particle, fixed ones included.
void addElasticForces(const Problem& problem, const std::vector<Eigen::Vector3d>& x,
                      std::vector<Eigen::Vector3d>& force);

/// No vibration about a state without strong compression (links longer than half their rest length) is faster
/// than this [rad/s].
double largestFrequency(const Problem& problem);

} // namespace sinew::sim::reference
