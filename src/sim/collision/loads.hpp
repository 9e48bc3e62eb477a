// The longest substep in which contacts between particles bear the weight that may rest on them.
#pragma once

#include "sinew/scene.hpp"

#include <span>
#include <vector>

namespace sinew::sim::collision::loads {

/// Allowed overlap of a contact under its load, as a share of the mean radius of both.
inline constexpr double give = 0.01;

/// Mass of other bodies that may rest on each particle [kg], estimated from initial positions: everything
/// above it along gravity, down to static particles (footprints.hpp). A sphere shares its mass among the
/// particles below its footprint. A heap, in which more contacts share the load, gives about the same result;
/// bodies that stand on less than their width, and impacts, give more. `bodies` has the component of each
/// particle.
std::vector<double> massesOnto(const Scene& scene, std::span<const float> inverseMass,
                               std::span<const std::uint32_t> bodies);

/// Under a load F a contact overlaps by h^2 F D, D = c_a w_a + c_b w_b, with c the contacts of each end:
/// twice those of its lower side, or of its upper side. They share the load that this end bears there, so
/// that F c is twice that load, whatever their number. Returns the longest substep [s] in which no contact
/// overlaps by more than `give` x the mean radius; infinite if nothing stands on anything.
double longestSubstep(const Scene& scene, std::span<const float> inverseMass,
                      std::span<const std::uint32_t> bodies);

} // namespace sinew::sim::collision::loads
