// How far parts of a sheet may move toward each other in a substep.
#pragma once

#include "sim/scene.hpp"

#include <cstdint>
#include <span>

namespace sinew::sim::stiffness {

/// The longest substep [s] in which no sheet, a component with faces that touch, falls onto itself by more
/// than a third of its thickness; infinite where no sheet falls. One part of a sheet meets another at the
/// speed of a fall as deep as the sheet reaches from its middle, and no faster than Scene::damping lets fall.
/// `components` says which particles hang together (componentsOf).
double longestFold(const Scene& scene, std::span<const float> inverseMass,
                   std::span<const std::uint32_t> components);

} // namespace sinew::sim::stiffness
