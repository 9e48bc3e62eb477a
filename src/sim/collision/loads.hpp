// How short a substep must be for contacts between particles to bear what may rest on them (contacts: 7, load
// check).
#pragma once

#include "sim/scene.hpp"

#include <span>
#include <vector>

namespace sinew::sim::collision::loads {

/// By how much a contact may give under its load, as a share of the mean radius of both.
inline constexpr double give = 0.01;

/// Mass that other bodies may put on each particle [kg], estimated from the start: what stands above it along
/// gravity, down to what never moves (footprints.hpp). A ball shares its mass among the particles below its
/// footprint. A heap, in which more contacts share the load, comes to as much; bodies that stand on less than
/// their width, and impacts, make more. `bodies` says which particles hang together.
std::vector<double> massesOnto(const Scene& scene, std::span<const float> inverseMass,
                               std::span<const std::uint32_t> bodies);

/// A contact under a load F gives by h^2 F D, D = c_a w_a + c_b w_b, c being the contacts of each end: twice
/// those of its lower side, or of its upper side. They share what that end bears there, so that F c is twice
/// that, however many they are. Returns the longest substep [s] in which no contact gives by more than `give`
/// x the mean radius; infinite where nothing stands on anything.
double longestSubstep(const Scene& scene, std::span<const float> inverseMass,
                      std::span<const std::uint32_t> bodies);

} // namespace sinew::sim::collision::loads
