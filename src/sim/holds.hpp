// Holding: particles that stay where the scene has them, or go along a path, chosen by where they are.
#pragma once

#include "sim/scene.hpp"

#include <functional>
#include <span>

namespace sinew::sim {

/// How far a point is outside of a place [m]; at most 0 within it. Any function will do: a host may ask a
/// distance field of its own.
using Gap = std::function<double(const Vec3&)>;

/// A sphere, capsule or box where it stands; its margin counts, its path does not.
Gap insideOf(const Collider& shape);
/// The free side of a plane: normal . x >= offset.
Gap insideOf(const Plane& halfSpace);

/// Particles of a body that are in a place, and how near the nearest one is to it.
struct Selection {
    std::vector<std::uint32_t> particles; ///< ascending
    std::uint32_t nearest = 0;            ///< the particle with the smallest gap
    double gap = 0;                       ///< its gap [m]; infinite where the body has no particle
};
Selection select(const Scene& scene, const Body& body, const Gap& gap);

/// Adds a FixedConstraint for each particle that has none, and ends its velocity. For every solver. Throws
/// std::invalid_argument for a particle that does not exist.
void hold(Scene& scene, std::span<const std::uint32_t> particles);

/// Holds the particles, and takes them along a path from where they are (DrivenBody). For `split` alone: a
/// particle may be driven once. Throws likewise.
void drive(Scene& scene, std::vector<std::uint32_t> particles, std::vector<Keyframe> path,
           PathEnd end = PathEnd::hold);

/// The first that has the particle; null where none has.
const NamedHold* holdOf(std::span<const NamedHold> holds, std::uint32_t particle);

} // namespace sinew::sim
