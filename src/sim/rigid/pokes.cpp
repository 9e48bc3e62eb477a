// Motion of pokes: a present poke moves towards its target, a new one starts at it.
#include "sim/rigid/pokes.hpp"

#include "sim/rigid/collider_paths.hpp"
#include "sinew/colliders.hpp"

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

bool hasSize(const Poke& poke) {
    const Vec3& e = poke.halfExtents;
    const auto isSize = [](float size) { return ranges::colliderSize.holds(double{size}); };
    switch (poke.shape) {
    case ColliderShape::sphere:
        return isSize(poke.radius);
    case ColliderShape::capsule:
        return isSize(poke.radius) && ranges::colliderLength.holds(double{poke.halfLength});
    case ColliderShape::box:
        return isSize(e.x) && isSize(e.y) && isSize(e.z);
    }
    return false;
}

bool isPossible(const Poke& poke) {
    const auto isFriction = [](float friction) { return ranges::friction.holds(double{friction}); };
    return hasSize(poke) && isFriction(poke.friction) && isFriction(poke.staticFriction) &&
           isPlace(poke.pose.position) && ranges::normalLength.holds(lengthOf(poke.pose.rotation)) &&
           !std::isnan(poke.maxSpeed);
}

bool hasShapeOf(const Poke& a, const Poke& b) {
    const Vec3 &e = a.halfExtents, &f = b.halfExtents;
    return a.shape == b.shape && a.radius == b.radius && a.halfLength == b.halfLength && e.x == f.x &&
           e.y == f.y && e.z == f.z;
}

// Distance from the middle to the farthest point.
double reachOf(const Poke& poke) {
    const Vec3& e = poke.halfExtents;
    if (poke.shape == ColliderShape::box) return std::hypot(double{e.x}, double{e.y}, double{e.z});
    return double{poke.radius} + (poke.shape == ColliderShape::capsule ? double{poke.halfLength} : 0);
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
// disappearance, other shape), above 0 while the poke is present, below 0 while absent; the first one is its
// reach before.
void Pokes::place(std::size_t slot, const Pose& from, double reach) noexcept {
    const PokeState& state = states_[slot];
    ways_[2 * slot] = onDevice(from, 1);
    ways_[2 * slot].position.w = static_cast<float>(reach);
    ways_[2 * slot + 1] = onDevice(state.poke.pose, 1);
    ways_[2 * slot + 1].position.w = static_cast<float>(state.changes) * (state.isThere ? 1.0f : -1.0f);
    shapes_[slot] = shapeOf(colliderOf(state.poke));
    shapes_[slot].isAbsent = state.isThere ? 0 : 1;
}

void Pokes::moveTo(const PokeStates& states) noexcept {
    states_ = states;
    for (std::size_t slot = 0; slot < count_; ++slot)
        place(slot, states_[slot].poke.pose, reachOf(states_[slot].poke));
}

void Pokes::advance(std::span<const Poke> pokes, float dt) noexcept {
    for (std::size_t slot = 0; slot < count_; ++slot) {
        PokeState& state = states_[slot];
        const Poke before = state.poke;
        const bool isThere = slot < pokes.size() && isPossible(pokes[slot]);
        const bool comes = isThere && !state.isThere;
        if (isThere != state.isThere || (isThere && !hasShapeOf(pokes[slot], before)))
            state.changes = state.changes % (mostChanges - 1) + 1;
        state.isThere = isThere;
        if (isThere) state.poke = pokes[slot];
        const Pose &target = state.poke.pose, from = comes ? target : before.pose;
        const double most = double{std::max(state.poke.maxSpeed, 0.0f)} * double{dt};
        state.poke.pose = movedTowards(from, target, reachOf(state.poke), most);
        place(slot, from, reachOf(before));
    }
}

bool Pokes::areAny() const noexcept {
    return std::ranges::any_of(states_, &PokeState::isThere);
}

} // namespace sinew::sim::rigid
