// Motion of host colliders: a present host collider moves towards its target, a new one starts at it.
#include "sim/rigid/host_colliders.hpp"

#include "sim/rigid/collider_paths.hpp"
#include "sinew/colliders.hpp"
#include "sinew/ranges.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::sim::rigid {

namespace {

constexpr std::uint32_t mostChanges = 1u << 24; // that a float represents exactly

// Whether squares of differences of such positions fit into float32.
bool isPlace(const Vec3& v) {
    constexpr float farthest = 1e9f; // [m]
    return std::abs(v.x) <= farthest && std::abs(v.y) <= farthest && std::abs(v.z) <= farthest;
}

double lengthOf(const Quaternion& q) {
    return std::sqrt(dot(q, q));
}

bool hasSize(const HostCollider& hostCollider) {
    const Vec3& e = hostCollider.halfExtents;
    const auto isSize = [](float size) { return ranges::colliderSize.holds(double{size}); };
    switch (hostCollider.shape) {
    case ColliderShape::sphere:
        return isSize(hostCollider.radius);
    case ColliderShape::capsule:
        return isSize(hostCollider.radius) && ranges::colliderLength.holds(double{hostCollider.halfLength});
    case ColliderShape::box:
        return isSize(e.x) && isSize(e.y) && isSize(e.z);
    }
    return false;
}

bool isPossible(const HostCollider& hostCollider) {
    const auto isFriction = [](float friction) { return ranges::friction.holds(double{friction}); };
    return hasSize(hostCollider) && isFriction(hostCollider.friction) &&
           isFriction(hostCollider.staticFriction) && isPlace(hostCollider.pose.position) &&
           ranges::normalLength.holds(lengthOf(hostCollider.pose.rotation)) &&
           !std::isnan(hostCollider.maxSpeed);
}

bool hasShapeOf(const HostCollider& a, const HostCollider& b) {
    const Vec3 &e = a.halfExtents, &f = b.halfExtents;
    return a.shape == b.shape && a.radius == b.radius && a.halfLength == b.halfLength && e.x == f.x &&
           e.y == f.y && e.z == f.z;
}

// Distance from the middle to the farthest point.
double reachOf(const HostCollider& hostCollider) {
    const Vec3& e = hostCollider.halfExtents;
    if (hostCollider.shape == ColliderShape::box) return std::hypot(double{e.x}, double{e.y}, double{e.z});
    return double{hostCollider.radius} +
           (hostCollider.shape == ColliderShape::capsule ? double{hostCollider.halfLength} : 0);
}

// The pose on the way to `to` at which no point has moved farther than `most` [m].
Pose movedTowards(const Pose& from, const Pose& to, double reach, double most) {
    const Vec3 &a = from.position, &b = to.position;
    const double cosine =
        std::abs(dot(from.rotation, to.rotation)) / (lengthOf(from.rotation) * lengthOf(to.rotation));
    const double turn = 2 * std::acos(std::min(cosine, 1.0));
    const double way =
        std::hypot(double{b.x} - double{a.x}, double{b.y} - double{a.y}, double{b.z} - double{a.z}) +
        turn * reach;
    Pose pose = way <= most ? to : between(from, to, most / way);
    Quaternion& q = pose.rotation;
    if (dot(from.rotation, q) < 0) q = {-q.x, -q.y, -q.z, -q.w}; // same rotation; the device interpolates
    return pose;
}

} // namespace

// The w of the positions lets kernels compare steps: the second one counts changes (appearance,
// disappearance, other shape), above 0 while the host collider is present, below 0 while absent; the first
// one is its reach before.
void HostColliders::place(std::size_t slot, const Pose& from, double reach) noexcept {
    const HostColliderState& state = states_[slot];
    ways_[2 * slot] = onDevice(from, 1);
    ways_[2 * slot].position.w = static_cast<float>(reach);
    ways_[2 * slot + 1] = onDevice(state.hostCollider.pose, 1);
    ways_[2 * slot + 1].position.w = static_cast<float>(state.changes) * (state.isThere ? 1.0f : -1.0f);
    shapes_[slot] = shapeOf(colliderOf(state.hostCollider));
    shapes_[slot].isAbsent = state.isThere ? 0 : 1;
}

void HostColliders::moveTo(std::span<const HostColliderState> states) noexcept {
    for (std::size_t slot = 0; slot < states_.size(); ++slot) {
        states_[slot] = slot < states.size() ? states[slot] : HostColliderState{};
        place(slot, states_[slot].hostCollider.pose, reachOf(states_[slot].hostCollider));
    }
}

void HostColliders::advance(std::span<const HostCollider> hostColliders, float dt) noexcept {
    for (std::size_t slot = 0; slot < states_.size(); ++slot) {
        HostColliderState& state = states_[slot];
        const HostCollider before = state.hostCollider;
        const bool isThere = slot < hostColliders.size() && isPossible(hostColliders[slot]);
        const bool comes = isThere && !state.isThere;
        if (isThere != state.isThere || (isThere && !hasShapeOf(hostColliders[slot], before)))
            state.changes = state.changes % (mostChanges - 1) + 1;
        state.isThere = isThere;
        if (isThere) state.hostCollider = hostColliders[slot];
        const Pose &target = state.hostCollider.pose, from = comes ? target : before.pose;
        const double most = double{std::max(state.hostCollider.maxSpeed, 0.0f)} * double{dt};
        state.hostCollider.pose = movedTowards(from, target, reachOf(state.hostCollider), most);
        place(slot, from, reachOf(before));
    }
}

bool HostColliders::areAny() const noexcept {
    return std::ranges::any_of(states_, &HostColliderState::isThere);
}

} // namespace sinew::sim::rigid
