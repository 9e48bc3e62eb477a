// The tension that the weight of a body may cause in each of its links.
#pragma once

#include "sinew/scene.hpp"

#include <span>
#include <vector>

namespace sinew::sim::stiffness {

/// The tension of each distance constraint at rest [N]; 0 if nothing hangs on it. A body is held by its
/// static particles, by its attachments, and by supports below it along gravity (carried.hpp): colliders at
/// the times of their keyframes, and initially faces and particles of other bodies. Each particle passes its
/// weight, a part of the weight of other bodies on it (collision/loads.hpp), and the load passed to it, on to
/// neighbours nearer to what holds the body, through links that lead straight there. A span between two holds
/// pulls at a slope: with the sag of a link stretched by `tolerance`, if it has no slack. Links to a corner
/// of a box or of a body bear more. `components` is that of componentsOf(). The result is the largest tension
/// over all these times.
std::vector<double> tensionsOf(const Scene& scene, std::span<const float> inverseMass,
                               std::span<const std::uint32_t> components, double tolerance);

} // namespace sinew::sim::stiffness
