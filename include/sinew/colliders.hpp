// Geometry of single colliders and driven bodies for rendering and measuring: poses on their paths, and
// distances to points.
#pragma once

#include "sinew/export.hpp"
#include "sinew/scene.hpp"

namespace sinew::sim {

struct HostCollider;

/// All particles of a driven body: those of its range, then the listed ones.
SINEW_API std::vector<std::uint32_t> particlesOf(const DrivenBody& body);

/// Whether its path changes its pose.
SINEW_API bool isMoving(const Collider& collider);
SINEW_API bool isMoving(const DrivenBody& body);

/// Pose at `time` [s] since the start of the simulation. Never throws or allocates.
SINEW_API Pose poseAt(const Collider& collider, double time) noexcept;
SINEW_API Pose poseAt(const DrivenBody& body, double time) noexcept;

/// A collider with the shape and surface of `host collider`.
SINEW_API Collider colliderOf(const HostCollider& hostCollider) noexcept;

/// The cosine of half the angle between two rotations; its sign may be either.
SINEW_API double dot(const Quaternion& a, const Quaternion& b) noexcept;
/// The pose at the share `part`, from 0 to 1, of the way from `a` to `b`, at constant rates; turns the
/// shorter way. Never throws or allocates.
SINEW_API Pose between(const Pose& a, const Pose& b, double part) noexcept;

/// Transforms `point` into the frame of `pose`, and back.
SINEW_API Vec3 toLocal(const Pose& pose, const Vec3& point) noexcept;
SINEW_API Vec3 toWorld(const Pose& pose, const Vec3& point) noexcept;

/// Distance from the collider's surface, without its margin, to `point`; below 0 inside [m].
SINEW_API double gapTo(const Collider& collider, const Pose& pose, const Vec3& point) noexcept;

} // namespace sinew::sim
