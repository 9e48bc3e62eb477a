// How far parts of a sheet may move toward each other in a substep.
#pragma once

#include "sim/scene.hpp"

#include <cstdint>
#include <span>

namespace sinew::sim::stiffness {

/// The longest substep [s] in which no sheet, a component with faces that touch, moves toward itself by more
/// than a part of its thickness; infinite where no sheet falls:
/// - 0.35 at the speed of a fall as deep as the sheet reaches from its middle, as one half of a fold meets
/// the
///   other, and
/// - 0.12 at the speed of the fall of a sheet that stands upright, since its upper part falls onto the lower
/// one
///   in many folds. Only a part of the fall counts, by which the sheet is upright: its height over twice its
///   reach (0.71 of a square).
/// No fall is deeper than there is room above colliders, planes and other bodies at the start, or faster than
/// Scene::damping allows. Sheets that hang on something are not regarded. `components` says which particles
/// hang together (componentsOf).
double longestSubstepOfFolds(const Scene& scene, std::span<const float> inverseMass,
                             std::span<const std::uint32_t> components);

} // namespace sinew::sim::stiffness
