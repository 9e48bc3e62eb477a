// Keyframe paths in double: positions linear in time, rotations by slerp [Shoemake 1985].
#include "sinew/colliders.hpp"

#include "sinew/step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace sinew::sim {

namespace {

float weighted(double p, float a, double q, float b) {
    return static_cast<float>(p * double{a} + q * double{b});
}

Quaternion between(const Quaternion& a, const Quaternion& b, double part) noexcept {
    const double cosine = dot(a, b), sign = cosine < 0 ? -1 : 1,
                 angle = std::acos(std::min(sign * cosine, 1.0));
    const double sine = std::sin(angle);
    const bool isNear = sine < 1e-6;
    const double p = isNear ? 1 - part : std::sin((1 - part) * angle) / sine,
                 q = sign * (isNear ? part : std::sin(part * angle) / sine);
    return {weighted(p, a.x, q, b.x), weighted(p, a.y, q, b.y), weighted(p, a.z, q, b.z),
            weighted(p, a.w, q, b.w)};
}

using Point = std::array<double, 3>;

// With `sign` -1 the inverse rotation.
Point rotated(const Quaternion& q, double sign, const Point& x) {
    const double w = double{q.w};
    const Point u{sign * double{q.x}, sign * double{q.y}, sign * double{q.z}};
    const auto cross = [](const Point& a, const Point& b) {
        return Point{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    Point turned = cross(u, x);
    for (std::size_t axis = 0; axis < 3; ++axis) turned[axis] += w * x[axis];
    turned = cross(u, turned);
    return {x[0] + 2 * turned[0], x[1] + 2 * turned[1], x[2] + 2 * turned[2]};
}

// `point` in the frame of `pose`.
Point localOf(const Pose& pose, const Vec3& point) {
    return rotated(pose.rotation, -1,
                   {double{point.x} - double{pose.position.x}, double{point.y} - double{pose.position.y},
                    double{point.z} - double{pose.position.z}});
}

Vec3 toFloats(const Point& x) {
    return {static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])};
}

Pose poseOn(const std::vector<Keyframe>& path, PathEnd end, double time) noexcept {
    const double first = double{path.front().time}, length = double{path.back().time} - first;
    if (end == PathEnd::loop && time > first && length > 0) time = first + std::fmod(time - first, length);
    const auto next =
        std::ranges::find_if(path, [&](const Keyframe& key) { return double{key.time} > time; });
    if (next == path.begin()) return path.front().pose;
    if (next == path.end()) return path.back().pose;
    const Keyframe& last = *(next - 1);
    return between(last.pose, next->pose,
                   (time - double{last.time}) / (double{next->time} - double{last.time}));
}

// Half extents of the box that the shape's radius encloses.
Point coreOf(const Collider& collider) {
    const Vec3& e = collider.halfExtents;
    if (collider.shape == ColliderShape::box) return {double{e.x}, double{e.y}, double{e.z}};
    return {0, collider.shape == ColliderShape::capsule ? double{collider.halfLength} : 0, 0};
}

} // namespace

double dot(const Quaternion& a, const Quaternion& b) noexcept {
    return double{a.x} * double{b.x} + double{a.y} * double{b.y} + double{a.z} * double{b.z} +
           double{a.w} * double{b.w};
}

Pose between(const Pose& a, const Pose& b, double part) noexcept {
    const Vec3 &from = a.position, &to = b.position;
    return {{weighted(1 - part, from.x, part, to.x), weighted(1 - part, from.y, part, to.y),
             weighted(1 - part, from.z, part, to.z)},
            between(a.rotation, b.rotation, part)};
}

std::vector<std::uint32_t> particlesOf(const DrivenBody& body) {
    std::vector<std::uint32_t> all(body.particleCount);
    std::iota(all.begin(), all.end(), body.firstParticle);
    all.insert(all.end(), body.particles.begin(), body.particles.end());
    return all;
}

bool isMoving(const Collider& collider) {
    return collider.path.size() > 1;
}

bool isMoving(const DrivenBody& body) {
    return body.path.size() > 1;
}

Pose poseAt(const Collider& collider, double time) noexcept {
    return collider.path.empty() ? collider.pose : poseOn(collider.path, collider.pathEnd, time);
}

Pose poseAt(const DrivenBody& body, double time) noexcept {
    return body.path.empty() ? Pose{} : poseOn(body.path, body.pathEnd, time);
}

Collider colliderOf(const HostCollider& hostCollider) noexcept {
    Collider collider{.shape = hostCollider.shape,
                      .radius = hostCollider.radius,
                      .halfLength = hostCollider.halfLength,
                      .halfExtents = hostCollider.halfExtents,
                      .friction = hostCollider.friction,
                      .staticFriction = hostCollider.staticFriction};
    collider.pose = hostCollider.pose;
    return collider;
}

Vec3 toLocal(const Pose& pose, const Vec3& point) noexcept {
    return toFloats(localOf(pose, point));
}

Vec3 toWorld(const Pose& pose, const Vec3& point) noexcept {
    const Vec3& p = pose.position;
    Point x = rotated(pose.rotation, 1, {double{point.x}, double{point.y}, double{point.z}});
    x[0] += double{p.x};
    x[1] += double{p.y};
    x[2] += double{p.z};
    return toFloats(x);
}

double gapTo(const Collider& collider, const Pose& pose, const Vec3& point) noexcept {
    const Point s = localOf(pose, point), core = coreOf(collider);
    double square = 0, nearest = -INFINITY;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double out = std::abs(s[axis]) - core[axis];
        square += std::max(out, 0.0) * std::max(out, 0.0);
        nearest = std::max(nearest, out);
    }
    const double radius = collider.shape == ColliderShape::box ? 0 : double{collider.radius};
    return std::sqrt(square) + std::min(nearest, 0.0) - radius;
}

} // namespace sinew::sim
