// Holding of particles that are chosen by position: they stay fixed, or follow a path.
#pragma once

#include "sinew/export.hpp"
#include "sinew/scene.hpp"

#include <functional>
#include <span>

namespace sinew::sim {

/// Distance of a point from a region [m]; at most 0 inside. Any function is allowed, such as a host's own
/// distance field.
using Gap = std::function<double(const Vec3&)>;

/// The inside of a sphere, capsule or box at its pose; its margin counts, its path does not.
SINEW_API Gap insideOf(const Collider& shape);
/// The free side of a plane: normal . x >= offset.
SINEW_API Gap insideOf(const Plane& halfSpace);

/// The particles of a body that are in a region, and the distance of the nearest one.
struct SINEW_API Selection {
    std::vector<std::uint32_t> particles; ///< ascending
    std::uint32_t nearest = 0;            ///< the particle with the smallest gap
    double gap = 0;                       ///< its gap [m]; infinite where the body has no particle
};
SINEW_API Selection select(const Scene& scene, const Body& body, const Gap& gap);

/// Adds a FixedConstraint for each particle that has none, and zeroes its velocity. For every solver. Throws
/// std::invalid_argument for a particle that does not exist.
SINEW_API void hold(Scene& scene, std::span<const std::uint32_t> particles);

/// Holds the particles, and moves them along a path from their present positions (DrivenBody). `split` only:
/// a particle may be driven once. Throws std::invalid_argument for a particle that does not exist.
SINEW_API void drive(Scene& scene, std::vector<std::uint32_t> particles, std::vector<Keyframe> path,
                     PathEnd end = PathEnd::hold);

/// The first hold that contains the particle; null if none does.
SINEW_API const NamedHold* holdOf(std::span<const NamedHold> holds, std::uint32_t particle);

} // namespace sinew::sim
