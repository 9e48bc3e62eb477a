// Which particles have something below them that carries them.
#pragma once

#include "sim/collision/vectors.hpp"
#include "sim/scene.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace sinew::sim::stiffness {

/// What holds particles, and for how much of their load.
struct Holds {
    std::vector<bool> isHeld;
    std::vector<bool> isSharp; ///< held by a shape that may have corners: a box, faces
};

/// Times at which colliders may begin to carry something: those of keyframes, at most 32 [s].
std::vector<double> timesOf(const Scene& scene);

/// Adds particles for which a collider is below them at `time`, along the unit vector `down`; of a round one
/// the part that is not steep.
void addCarriedByColliders(const Scene& scene, double time, const collision::Vector& down, Holds& holds);

/// Adds particles for which something of another component is below them at the start: a face that is not
/// steep, or a particle that touches others. Only particles that touch others, or are corners of faces.
/// `components` says which particles hang together (componentsOf).
void addCarriedByBodies(const Scene& scene, std::span<const std::uint32_t> components,
                        const collision::Vector& down, Holds& holds);

} // namespace sinew::sim::stiffness
