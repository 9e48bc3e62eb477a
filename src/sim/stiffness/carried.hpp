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

/// Supports of the particles `asked` of a scene: looks along the unit vector `down` for colliders, and, for
/// particles that touch others, for faces and particles of other components that touch; of round ones and
/// faces the parts that are not steep. `components` says which particles hang together (componentsOf). Keeps
/// its arguments by reference. Bodies are looked for once, unless one goes along a path.
class Supports {
public:
    Supports(const Scene& scene, std::span<const std::uint32_t> components, const collision::Vector& down,
             std::span<const std::uint32_t> asked);

    /// Colliders and driven bodies are where their paths lead at `time` [s], others where they begin.
    Support at(double time) const;

private:
    void addBodies(double time, Support& support) const;
    void addColliders(double time, Support& support) const;

    const Scene& scene_;
    std::span<const std::uint32_t> components_, asked_;
    collision::Vector down_;
    bool hasMovingBodies_;
    Support still_; ///< bodies at the start
};

} // namespace sinew::sim::stiffness
