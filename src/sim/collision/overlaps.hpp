// Pairs of particles that overlap when a scene is loaded. They are separated at a limited speed, whereas
// contacts that arise from motion are as stiff as a substep permits; or they keep their distance.
#pragma once

#include "sim/collision/contact_lists.hpp"

#include <array>
#include <span>
#include <vector>

namespace sinew::sim::collision::overlaps {

struct Request {
    std::span<const std::array<float, 3>> positions; ///< by state slot [m]
    std::span<const float> radii;                    ///< by state slot [m]; below 0 = touches nothing
    std::span<const float> inverseMasses;            ///< by state slot [1/kg]
    const contact_lists::Exclusions& exclusions;
    std::span<const std::uint8_t> keepsRest; ///< by state slot: Particle::keepsRest
    std::span<const std::uint32_t> arrivals; ///< by state slot: Body::arrival; empty = all equal
    float least = 0;                         ///< smallest overlap that counts [m]
    std::uint32_t limit = 0;                 ///< number of partners of a particle at which its search ends
};

struct Overlap {
    std::uint32_t other = 0; ///< slot
    float depth = 0;         ///< [m]; equal for both
    bool isKept = false;     ///< one of the two keeps its rest distance
};

/// Partners of each slot, sorted; empty if no pair overlaps by more than `least`, or touches and is kept.
/// Pairs of two static particles are left out. If one particle has more than `limit` partners, lists are
/// incomplete.
using Overlaps = std::vector<std::vector<Overlap>>;
Overlaps find(const Request& request);

/// Removes pairs that overlap by at most `least` and are not kept.
void forget(Overlaps& overlaps, float least);

/// Whether some pair is kept, or some pair is not.
bool haveKept(const Overlaps& overlaps);
bool haveParting(const Overlaps& overlaps);

/// The largest number of partners of a particle.
std::uint32_t mostPartners(const Overlaps& overlaps);

} // namespace sinew::sim::collision::overlaps
