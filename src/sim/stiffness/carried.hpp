// Supports of particles: objects below them that may carry them.
#pragma once

#include "sim/collision/vectors.hpp"
#include "sinew/scene.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace sinew::sim::stiffness {

/// The nearest support below each particle.
struct Support {
    std::vector<double> ways;  ///< distance to it along gravity [m]; infinite without a support
    std::vector<bool> isSharp; ///< whether it may end in a corner: a box, a flat face, a body; not round
};

/// Times at which an object on a path may begin to carry: those of keyframes, at most 32 [s].
std::vector<double> timesOf(const Scene& scene);

/// Supports of the particles `asked` of a scene. Searches along the unit vector `down` for colliders and, for
/// touching particles, for faces and touching particles of other components; of round ones and faces only the
/// parts that are not steep. `components` has the component of each particle (componentsOf). Keeps its
/// arguments by reference. Bodies are searched once, unless one follows a path.
class Supports {
public:
    Supports(const Scene& scene, std::span<const std::uint32_t> components, const collision::Vector& down,
             std::span<const std::uint32_t> asked);

    /// Supports with colliders and driven bodies at their poses at `time` [s], and other bodies at their
    /// initial positions.
    Support at(double time) const;

private:
    void addBodies(double time, Support& support) const;
    void addColliders(double time, Support& support) const;

    const Scene& scene_;
    std::span<const std::uint32_t> components_, asked_;
    collision::Vector down_;
    bool hasMovingBodies_;
    Support still_; ///< supports by bodies at the start
};

} // namespace sinew::sim::stiffness
