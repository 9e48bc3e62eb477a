// What follows from a collider alone, for whoever draws or measures: where its path leads, and how far away a
// point is.
#pragma once

#include "sim/scene.hpp"

namespace sinew::sim {

/// Whether its path leads anywhere.
bool isMoving(const Collider& collider);

/// Where it is at `time` [s] since the simulation began. Never throws or allocates.
Pose poseAt(const Collider& collider, double time) noexcept;

/// From its surface, its margin not counted, to `point`; below 0 inside [m].
double gapTo(const Collider& collider, const Pose& pose, const Vec3& point) noexcept;

} // namespace sinew::sim
