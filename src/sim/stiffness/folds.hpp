// The motion of parts of a sheet towards each other in a substep.
#pragma once

#include "sinew/scene.hpp"

#include <cstdint>
#include <span>

namespace sinew::sim::stiffness {

/// The longest substep [s] in which no sheet, a component with touching faces, moves towards itself by more
/// than a part of its thickness; infinite if no sheet falls:
/// - 0.6 at the speed of a fall as deep as the largest distance in the sheet from its middle, with which one
///   half of a fold meets the other, and
/// - 0.18 at the speed of the fall of an upright sheet, since its upper part falls onto the lower one in many
///   folds. This fall is scaled by the uprightness: the height over twice the largest distance from the
///   middle (0.71 for a square).
/// No fall is deeper than the initial free space above colliders, planes and other bodies, or faster than
/// Scene::damping allows. Hanging sheets are ignored. `components` has the component of each particle
/// (componentsOf).
double longestSubstepOfFolds(const Scene& scene, std::span<const float> inverseMass,
                             std::span<const std::uint32_t> components);

} // namespace sinew::sim::stiffness
