// What follows from a collider or a driven body alone, for whoever draws or measures: where its path leads,
// and how far away a point is.
#pragma once

#include "sim/scene.hpp"

namespace sinew::sim {

struct Poke;

/// All particles of a driven body: those of its range, then the listed ones.
std::vector<std::uint32_t> particlesOf(const DrivenBody& body);

/// Whether its path leads anywhere.
bool isMoving(const Collider& collider);
bool isMoving(const DrivenBody& body);

/// Where it is at `time` [s] since the simulation began. Never throws or allocates.
Pose poseAt(const Collider& collider, double time) noexcept;
Pose poseAt(const DrivenBody& body, double time) noexcept;

/// The collider that it is like.
Collider colliderOf(const Poke& poke) noexcept;

/// Of two rotations: the cosine of half the turn between them, of either sign.
double dot(const Quaternion& a, const Quaternion& b) noexcept;
/// Evenly from `a` to `b`, `part` of the way from 0 to 1; turns the shorter way. Likewise.
Pose between(const Pose& a, const Pose& b, double part) noexcept;

/// `point` in the frame of `pose`, and back.
Vec3 toLocal(const Pose& pose, const Vec3& point) noexcept;
Vec3 toWorld(const Pose& pose, const Vec3& point) noexcept;

/// From its surface, its margin not counted, to `point`; below 0 inside [m].
double gapTo(const Collider& collider, const Pose& pose, const Vec3& point) noexcept;

} // namespace sinew::sim
