// Energy of a scene's springs and cell volumes, and its consequences: forces, and a bound on the highest
// vibration frequency. For R1 and R2, the two references that solve equations of motion and imitate no
// solver.
#pragma once

#include "sim/reference/problem.hpp"

namespace sinew::sim::reference {

/// Throws std::invalid_argument, in one sentence that says `what` cannot be computed, for a scene with rigid
/// links (which have no energy), bends, attachments, tethers, boundary planes or colliders.
void requireSprings(const Scene& scene, const char* what);
/// The same for a scene with damping, of motion or of links.
void requireUndamped(const Scene& scene, const char* what);

/// Sum of (|x_a - x_b| - restLength)^2 / (2 compliance) and of the energies of cells [J].
double elasticEnergy(const Problem& problem, const std::vector<Eigen::Vector3d>& x);

/// Adds to `force` [N] the forces of springs and cells on every particle, fixed ones included.
void addElasticForces(const Problem& problem, const std::vector<Eigen::Vector3d>& x,
                      std::vector<Eigen::Vector3d>& force);

/// Upper bound of the angular frequency of vibrations about any state without strong compression (links
/// longer than half their rest length) [rad/s].
double largestFrequency(const Problem& problem);

} // namespace sinew::sim::reference
