// The part of validate() for colliders.
#pragma once

#include "sim/core/complaints.hpp"

#include <span>

namespace sinew::sim::rigid {

/// Whether two poses are equal; q and -q are one rotation.
bool isSame(const Pose& a, const Pose& b);

void checkColliders(std::span<const Collider> colliders, Complaints& complaints);
/// `isHeld` by particle: whether it never moves.
void checkDriven(const Scene& scene, const std::vector<bool>& isHeld, Complaints& complaints);

} // namespace sinew::sim::rigid
