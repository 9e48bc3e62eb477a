// Supports of particles: what is below them and may carry them.
#pragma once

#include "sim/collision/vectors.hpp"
#include "sim/scene.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace sinew::sim::stiffness {

/// The nearest support below each particle.
struct Support {
    std::vector<double> ways;  ///< how far below along gravity [m]; infinite where nothing is
    std::vector<bool> isSharp; ///< whether it may end in a corner: a box, a flat face, a body; no round thing
};

/// Times at which something that goes along a path may begin to carry: those of keyframes, at most 32 [s].
std::vector<double> timesOf(const Scene& scene);

/// Looks from the particles `asked` along the unit vector `down` for colliders, and, if they touch others,
/// for faces and particles of other components that touch; of round ones and faces the parts that are not
/// steep. Colliders and driven bodies are where their paths lead at `time`, others where they begin.
/// `components` says which particles hang together (componentsOf).
Support supportAt(const Scene& scene, double time, std::span<const std::uint32_t> components,
                  const collision::Vector& down, std::span<const std::uint32_t> asked);

} // namespace sinew::sim::stiffness
