// How short a substep must be for contacts between particles to bear what may rest on them (contacts: 7, load
// check).
#pragma once

#include "sim/scene.hpp"

#include <span>

namespace sinew::sim::collision::loads {

/// By how much a contact may give under its load, as a share of the radius.
inline constexpr double give = 0.01;

/// A contact under a load F gives by h^2 F D, D = c_a w_a + c_b w_b with the contacts c of both: two each,
/// one below and one above; a heap, in which more contacts share the load, comes to as much. The load is
/// estimated from the start: of two particles of different bodies that follow each other in a column as wide
/// as a particle, along gravity, it is all that stands above the lower one there, down to what never moves.
/// Returns the longest substep [s] in which none gives by more than `give` x the smaller radius; infinite
/// where nothing stands on anything. `bodies` says which particles hang together. Bodies that stand on less
/// than their width, and impacts, make more.
double longestSubstep(const Scene& scene, std::span<const float> inverseMass,
                      std::span<const std::uint32_t> bodies);

} // namespace sinew::sim::collision::loads
