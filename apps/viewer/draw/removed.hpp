// What says of a particle that it is drawn no more: the piece that it was part of is a crumb that was
// removed.
#pragma once

#include "sim/simulation.hpp"

namespace sinew::viewer {

/// A word a particle: REMOVED_PIECE of layout.h where it was removed (sim::Scene::crumbs), anything else
/// where not. Of the simulation's newest step, for vertex input and compute.
vk::BufferView removedParticles(const sim::Simulation& simulation);

} // namespace sinew::viewer
