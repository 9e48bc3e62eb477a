// The tension that the weight of a body may put on each of its links.
#pragma once

#include "sim/scene.hpp"

#include <span>
#include <vector>

namespace sinew::sim::stiffness {

/// The tension of each distance constraint at rest [N]; 0 where nothing hangs on it. A body is held by its
/// particles that never move, by its attachments, and by what is below it along gravity (carried.hpp):
/// colliders at the times of their keyframes, and at the start faces and particles of other bodies. Each
/// particle hands its weight, a part of what other bodies put on it (collision/loads.hpp), and what it was
/// handed, to its neighbours that are nearer to what holds the body, by links that lead straight there. A
/// span between two holds pulls at a slope: with the sag of a link stretched by `tolerance`, if it has no
/// slack. Links to a corner of a box or of a body bear more. `components` as of componentsOf(). The result is
/// the largest of the times.
std::vector<double> tensionsOf(const Scene& scene, std::span<const float> inverseMass,
                               std::span<const std::uint32_t> components, double tolerance);

} // namespace sinew::sim::stiffness
