// A key of the scenes that a state fits to: two scenes with one key differ in material alone.
#pragma once

#include "sim/scene.hpp"

namespace sinew::sim {

/// Hashes of all that recordTakeOver() takes for granted. Stiffness, compliance, friction, restitution,
/// damping, gravity, colors, names and velocities are not in them.
struct SceneKey {
    /// First places and masses of particles, their links, holds and surroundings.
    std::uint64_t ofAnySolver = 0;
    /// That, and what `split` alone has forms for: how far particles are from what they touch, their faces,
    /// which bodies may be cut or tear, and what a cut removes.
    std::uint64_t ofSplit = 0;
};
SceneKey sceneKey(const Scene& scene);

} // namespace sinew::sim
