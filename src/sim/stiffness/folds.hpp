// How far parts of a sheet may move toward each other in a substep.
#pragma once

#include "sim/scene.hpp"

#include <cstdint>
#include <span>

namespace sinew::sim::stiffness {

/// The longest substep [s] in which no sheet, a component with faces that touch, falls onto itself by more
/// than 0.35 of its thickness; infinite where no sheet falls. One part of a sheet meets another at the speed
/// of a fall as deep as the sheet reaches from its middle, but no deeper than there is room above colliders,
/// planes and other bodies at the start, and no faster than Scene::damping lets fall. Sheets that hang on
/// something are not regarded. `components` says which particles hang together (componentsOf).
double longestSubstepOfFolds(const Scene& scene, std::span<const float> inverseMass,
                             std::span<const std::uint32_t> components);

} // namespace sinew::sim::stiffness
