// Pairs of particles that overlap when a scene is loaded: they part at a limited speed (contacts: 3), while
// contacts that a motion makes are as stiff as a substep can have them; or they keep that distance.
#pragma once

#include "sim/collision/contact_lists.hpp"

#include <array>
#include <span>
#include <vector>

namespace sinew::sim::collision::overlaps {

struct Request {
    std::span<const std::array<float, 3>> positions; ///< by state slot [m]
    std::span<const float> radii;                    ///< likewise [m]; below 0 = touches nothing
    std::span<const float> inverseMasses;            ///< likewise [1/kg]
    const contact_lists::Exclusions& exclusions;
    std::span<const std::uint8_t> keepsRest; ///< likewise Particle::keepsRest
    float least = 0;                         ///< overlap that counts [m]
    std::uint32_t limit = 0;                 ///< partners of a particle after which it is not searched on
};

struct Overlap {
    std::uint32_t other = 0; ///< slot
    float depth = 0;         ///< [m]; the same for both
    bool isKept = false;     ///< stays as it is: one of the two keeps its rest distance
};

/// Partners of each slot, sorted; empty where no pair overlaps by more than `least`, or is kept and
/// touches. Pairs of two that never move are left out. With more than `limit` partners of one particle, lists
/// are not whole.
using Overlaps = std::vector<std::vector<Overlap>>;
Overlaps find(const Request& request);

/// Leaves those that overlap by more than `least`, or that are kept.
void forget(Overlaps& overlaps, float least);

/// Whether some pair is kept, or some is not.
bool haveKept(const Overlaps& overlaps);
bool haveParting(const Overlaps& overlaps);

/// The most partners that one particle has.
std::uint32_t mostPartners(const Overlaps& overlaps);

} // namespace sinew::sim::collision::overlaps
