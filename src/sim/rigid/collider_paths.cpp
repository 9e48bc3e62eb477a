// The poses of colliders on their paths in a step, for the device.
#include "sim/rigid/collider_paths.hpp"

#include <algorithm>
#include <utility>

namespace sinew::sim::rigid {

layout::ColliderPose onDevice(const Pose& pose, float sign) noexcept {
    const Vec3& x = pose.position;
    const Quaternion& q = pose.rotation;
    return {{x.x, x.y, x.z, 0}, {sign * q.x, sign * q.y, sign * q.z, sign * q.w}};
}

layout::Collider shapeOf(const Collider& collider) noexcept {
    layout::Collider shape{.core = {0, 0, 0, collider.radius + collider.margin},
                           .friction = collider.friction,
                           .staticFriction = std::max(collider.friction, collider.staticFriction),
                           .restitution = collider.restitution,
                           .isAbsent = 0};
    const Vec3& extents = collider.halfExtents;
    if (collider.shape == ColliderShape::capsule) shape.core.y = collider.halfLength;
    if (collider.shape == ColliderShape::box) shape.core = {extents.x, extents.y, extents.z, collider.margin};
    return shape;
}

ColliderPaths::ColliderPaths(std::vector<Collider> colliders, std::vector<DrivenBody> driven,
                             std::uint32_t hostColliders)
    : colliders_(std::move(colliders)), driven_(std::move(driven)), hostColliders_(hostColliders),
      poses_(colliders_.size() + driven_.size()) {
    const auto moves = [](const auto& item) { return isMoving(item); };
    if (hostColliders > 0 || std::ranges::any_of(colliders_, moves) || std::ranges::any_of(driven_, moves))
        ways_.resize(2 * (hostColliders + poses_.size()));
    moveTo(0);
}

void ColliderPaths::place() noexcept {
    for (std::size_t c = 0; c < colliders_.size(); ++c) poses_[c] = poseAt(colliders_[c], time_);
    for (std::size_t d = 0; d < driven_.size(); ++d)
        poses_[colliders_.size() + d] = poseAt(driven_[d], time_);
    std::ranges::copy(hostColliders_.ways(), ways_.begin());
}

void ColliderPaths::moveTo(double time, std::span<const HostColliderState> hostColliders) noexcept {
    time_ = time;
    hostColliders_.moveTo(hostColliders);
    place();
    if (ways_.empty()) return;
    layout::ColliderPose* way = ways_.data() + hostColliders_.ways().size();
    for (const Pose& pose : poses_) {
        *way++ = onDevice(pose, 1);
        *way++ = onDevice(pose, 1);
    }
}

void ColliderPaths::advance(float dt, std::span<const HostCollider> hostColliders) noexcept {
    time_ += double{dt};
    if (ways_.empty()) return;
    hostColliders_.advance(hostColliders, dt);
    place();
    layout::ColliderPose* way = ways_.data() + hostColliders_.ways().size();
    for (const Pose& pose : poses_) {
        layout::ColliderPose &from = way[0], &to = way[1];
        from = to;
        // q and -q are one rotation, but the device interpolates components
        const layout::vec4& q = from.rotation;
        to = onDevice(pose, dot({q.x, q.y, q.z, q.w}, pose.rotation) < 0 ? -1.0f : 1.0f);
        way += 2;
    }
}

} // namespace sinew::sim::rigid
