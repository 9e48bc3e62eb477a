// What the device reads of the paths of a step.
#include "sim/collision/collider_paths.hpp"

#include <algorithm>
#include <utility>

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

ColliderPaths::ColliderPaths(std::vector<Collider> colliders, std::vector<DrivenBody> driven)
    : colliders_(std::move(colliders)), driven_(std::move(driven)),
      poses_(colliders_.size() + driven_.size()) {
    const auto moves = [](const auto& item) { return isMoving(item); };
    if (std::ranges::any_of(colliders_, moves) || std::ranges::any_of(driven_, moves))
        ways_.resize(2 * poses_.size());
    moveTo(0);
}

void ColliderPaths::place() noexcept {
    for (std::size_t c = 0; c < colliders_.size(); ++c) poses_[c] = poseAt(colliders_[c], time_);
    for (std::size_t d = 0; d < driven_.size(); ++d)
        poses_[colliders_.size() + d] = poseAt(driven_[d], time_);
}

void ColliderPaths::moveTo(double time) noexcept {
    time_ = time;
    place();
    for (std::size_t p = 0; 2 * p < ways_.size(); ++p)
        ways_[2 * p] = ways_[2 * p + 1] = onDevice(poses_[p], 1);
}

void ColliderPaths::advance(float dt) noexcept {
    time_ += double{dt};
    if (ways_.empty()) return;
    place();
    for (std::size_t p = 0; p < poses_.size(); ++p) {
        layout::ColliderPose &from = ways_[2 * p], &to = ways_[2 * p + 1];
        from = to;
        // q and -q are one rotation: the device mixes numbers
        const layout::vec4& q = from.rotation;
        const float sign = dot({q.x, q.y, q.z, q.w}, poses_[p].rotation) < 0 ? -1.0f : 1.0f;
        to = onDevice(poses_[p], sign);
    }
}

} // namespace sinew::sim::collision
