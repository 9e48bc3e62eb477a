// Key of the scenes that a state fits: scenes with equal keys differ only in material.
#pragma once

#include "sinew/scene.hpp"

namespace sinew::sim {

/// Hashes of everything that recordTakeOver() requires to be equal. Stiffness, compliance, friction,
/// restitution, damping, gravity, colors, names and velocities are not part of them.
struct SceneKey {
    /// Initial positions and masses of particles, their links, holds and surroundings.
    std::uint64_t ofAnySolver = 0;
    /// ofAnySolver, and the features that only `split` supports: contact distances, faces, which bodies are
    /// cuttable or tear, and which fragments a cut removes.
    std::uint64_t ofSplit = 0;
};
SceneKey sceneKey(const Scene& scene);

} // namespace sinew::sim
