// A key of the scenes that a state fits to: two scenes with one key differ in material alone.
#pragma once

#include "sim/scene.hpp"

namespace sinew::sim {

/// A hash of where particles are at first, how heavy, and how far from what they touch; of what links, holds
/// and surrounds them; of which bodies may be cut or tear, and what a cut removes: of all that
/// recordTakeOver() takes for granted. Stiffness, compliance, friction, restitution, damping, gravity,
/// colors, names and velocities are not in it.
std::uint64_t sceneKey(const Scene& scene);

} // namespace sinew::sim
