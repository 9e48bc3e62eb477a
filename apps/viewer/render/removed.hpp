// Marks of particles that are no longer drawn, because their piece was removed as a fragment.
#pragma once

#include "sinew/simulation.hpp"

namespace sinew::viewer {

/// One word per particle: REMOVED_PIECE of layout.h if it was removed (sim::Scene::debris), any other value
/// if not. State of the simulation's newest step, for vertex input and compute.
vk::BufferView removedParticles(const sim::Simulation& simulation);

} // namespace sinew::viewer
