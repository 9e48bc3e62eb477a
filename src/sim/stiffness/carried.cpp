// Colliders are tested for each particle. Other bodies are projected along gravity into columns of particles.
#include "sim/stiffness/carried.hpp"

#include "sim/stiffness/columns.hpp"
#include "sinew/colliders.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::sim::stiffness {

namespace {

using collision::acrossLength;
using collision::cross;
using collision::dot;
using collision::minus;
using collision::toVector;
using collision::Vector;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double steepest = 0.5; // sine of the slope on which friction still holds
constexpr double flattest =
    0.26; // sine of the slope at a rim below which the rim is an edge; a round top has the steepest there
constexpr std::size_t mostTimes = 32; // of keyframes that are examined

// Distance to a collider along a ray from `from`, in its frame; on a round one only where it is not steep;
// infinite if the ray misses it.
double wayTo(const Collider& collider, double kept, const Vector& from, const Vector& down) {
    if (collider.shape == ColliderShape::box) {
        const Vector half = toVector(collider.halfExtents);
        double enters = -infinite, leaves = infinite;
        for (std::size_t k = 0; k < 3; ++k) {
            const double reach = half[k] + kept;
            if (down[k] == 0 && std::abs(from[k]) > reach) return infinite;
            if (down[k] == 0) continue;
            const auto [first, last] =
                std::minmax({(-reach - from[k]) / down[k], (reach - from[k]) / down[k]});
            enters = std::max(enters, first);
            leaves = std::min(leaves, last);
        }
        return enters <= leaves && leaves >= 0 ? std::max(0.0, enters) : infinite;
    }
    // the point of the capsule's axis nearest to the line of the ray
    const double half = collider.shape == ColliderShape::capsule ? double{collider.halfLength} : 0;
    const double flat = 1 - down[1] * down[1];
    const double height = from[1] - dot(from, down) * down[1];
    const double y = flat > 1e-12 ? std::clamp(height / flat, -half, half) : (down[1] < 0 ? -half : half);
    const Vector toAxis{-from[0], y - from[1], -from[2]};
    const double reach = double{collider.radius} + kept, depth = dot(toAxis, down);
    return acrossLength(toAxis, down) <= steepest * reach && depth >= -reach ? std::max(0.0, depth - reach)
                                                                             : infinite;
}

// The sine of a triangle's slope relative to the horizontal.
double slopeOf(const std::array<Vector, 3>& corners, const Vector& down) {
    const Vector normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    return acrossLength(normal, down) / std::sqrt(std::max(1e-300, dot(normal, normal)));
}

// Positions at `time` of particles on paths, and initial positions of others.
std::vector<Vector> placesAt(const Scene& scene, double time) {
    std::vector<Vector> places;
    for (const Particle& particle : scene.particles) places.push_back(toVector(particle.position));
    for (const DrivenBody& body : scene.driven)
        for (const std::uint32_t i : particlesOf(body))
            places[i] =
                toVector(toWorld(poseAt(body, time), toLocal(poseAt(body, 0), scene.particles[i].position)));
    return places;
}

void lower(Support& support, std::uint32_t i, double way, bool isSharp) {
    if (way >= support.ways[i]) return;
    support.ways[i] = way;
    support.isSharp[i] = isSharp;
}

// Contact distance of each touching particle: its radius, or half the thickness of its faces.
std::vector<double> reachesOf(const Scene& scene) {
    std::vector<double> reaches;
    for (const Particle& particle : scene.particles) reaches.push_back(double{particle.radius});
    for (const Face& face : scene.faces)
        for (const std::uint32_t corner : face.particles)
            reaches[corner] = std::max(reaches[corner], double{face.thickness});
    return reaches;
}

} // namespace

std::vector<double> timesOf(const Scene& scene) {
    std::vector<double> times{0};
    for (const Collider& collider : scene.colliders)
        for (const Keyframe& key : collider.path) times.push_back(double{key.time});
    for (const DrivenBody& body : scene.driven)
        for (const Keyframe& key : body.path) times.push_back(double{key.time});
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    if (times.size() <= mostTimes) return times;
    std::vector<double> some;
    for (std::size_t k = 0; k < mostTimes; ++k)
        some.push_back(times[k * (times.size() - 1) / (mostTimes - 1)]);
    return some;
}

Supports::Supports(const Scene& scene, std::span<const std::uint32_t> components, const Vector& down,
                   std::span<const std::uint32_t> asked)
    : scene_(scene), components_(components), asked_(asked), down_(down),
      hasMovingBodies_(
          std::ranges::any_of(scene.driven, [](const DrivenBody& body) { return isMoving(body); })),
      still_{.ways = std::vector(scene.particles.size(), infinite),
             .isSharp = std::vector<bool>(scene.particles.size())} {
    if (!hasMovingBodies_) addBodies(0, still_);
}

Support Supports::at(double time) const {
    Support support = still_;
    if (hasMovingBodies_) addBodies(time, support);
    addColliders(time, support);
    return support;
}

void Supports::addColliders(double time, Support& support) const {
    for (const Collider& collider : scene_.colliders) {
        const Pose pose = poseAt(collider, time);
        const Vec3 down{static_cast<float>(down_[0]), static_cast<float>(down_[1]),
                        static_cast<float>(down_[2])};
        const Vector localDown = toVector(toLocal({.position = {}, .rotation = pose.rotation}, down));
        for (const std::uint32_t i : asked_) {
            const double kept = double{collider.margin} + double{scene_.particles[i].contactOffset};
            lower(support, i,
                  wayTo(collider, kept, toVector(toLocal(pose, scene_.particles[i].position)), localDown),
                  collider.shape == ColliderShape::box);
        }
    }
}

void Supports::addBodies(double time, Support& support) const {
    const std::vector<Vector> places = placesAt(scene_, time);
    const std::vector<double> reaches = reachesOf(scene_);
    std::vector<std::uint32_t> touching;
    std::ranges::copy_if(asked_, std::back_inserter(touching),
                         [&](std::uint32_t i) { return reaches[i] > 0; });
    if (touching.empty()) return;
    std::vector<bool> isLinked(scene_.particles.size());
    for (const DistanceConstraint& c : scene_.distances) isLinked[c.a] = isLinked[c.b] = true;
    const Columns columns(scene_, places, touching, down_);
    const auto take = [&](std::uint32_t component, bool isSharp) {
        return [&, component, isSharp](std::uint32_t i, double way) {
            if (components_[i] != component && way > -reaches[i])
                lower(support, i, std::max(0.0, way), isSharp);
        };
    };
    std::vector<bool> isCorner(scene_.particles.size()); // faces represent it
    for (const Face& face : scene_.faces)
        for (const std::uint32_t corner : face.particles) isCorner[corner] = true;
    for (std::uint32_t i = 0; i < reaches.size(); ++i)
        if (const double radius{scene_.particles[i].radius}; radius > 0 && !isCorner[i])
            columns.visitBelow(places[i], isLinked[i] ? radius : steepest * radius,
                               take(components_[i], isLinked[i]));
    for (const Face& face : scene_.faces) {
        const std::array corners{places[face.particles[0]], places[face.particles[1]],
                                 places[face.particles[2]]};
        const double slope = slopeOf(corners, down_);
        if (slope <= steepest)
            columns.visitBelow(corners, take(components_[face.particles[0]], slope < flattest));
    }
}

} // namespace sinew::sim::stiffness
