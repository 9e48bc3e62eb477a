// What the device reads of the paths of a step.
#include "sim/collision/collider_paths.hpp"

#include <algorithm>

namespace sinew::sim::collision {

namespace {

double dot(const Quaternion& a, const Quaternion& b) {
    return double{a.x} * double{b.x} + double{a.y} * double{b.y} + double{a.z} * double{b.z} +
           double{a.w} * double{b.w};
}

layout::ColliderPose onDevice(const Pose& pose, float sign) {
    const Vec3& x = pose.position;
    const Quaternion& q = pose.rotation;
    return {{x.x, x.y, x.z, 0}, {sign * q.x, sign * q.y, sign * q.z, sign * q.w}};
}

} // namespace

ColliderPaths::ColliderPaths(const std::vector<Collider>& colliders)
    : colliders_(colliders), poses_(colliders.size()) {
    if (std::ranges::any_of(colliders, isMoving)) ways_.resize(2 * colliders.size());
    moveTo(0);
}

void ColliderPaths::moveTo(double time) noexcept {
    time_ = time;
    for (std::size_t c = 0; c < colliders_.size(); ++c) {
        poses_[c] = poseAt(colliders_[c], time_);
        if (!ways_.empty()) ways_[2 * c] = ways_[2 * c + 1] = onDevice(poses_[c], 1);
    }
}

void ColliderPaths::advance(float dt) noexcept {
    time_ += double{dt};
    for (std::size_t c = 0; c < colliders_.size() && !ways_.empty(); ++c) {
        poses_[c] = poseAt(colliders_[c], time_);
        layout::ColliderPose &from = ways_[2 * c], &to = ways_[2 * c + 1];
        from = to;
        // q and -q are one rotation: the device mixes numbers
        const layout::vec4& q = from.rotation;
        const float sign = dot({q.x, q.y, q.z, q.w}, poses_[c].rotation) < 0 ? -1.0f : 1.0f;
        to = onDevice(poses_[c], sign);
    }
}

} // namespace sinew::sim::collision
