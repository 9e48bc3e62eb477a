// Part of validate(): complaints about colliders.
#pragma once

#include "sim/complaints.hpp"

#include <span>

namespace sinew::sim::collision {

/// Whether two keyframes put a thing in the same place: q and -q are one rotation.
bool isSame(const Pose& a, const Pose& b);

void checkColliders(std::span<const Collider> colliders, Complaints& complaints);
/// `isHeld` by particle: never moves.
void checkDriven(const Scene& scene, const std::vector<bool>& isHeld, Complaints& complaints);

} // namespace sinew::sim::collision
