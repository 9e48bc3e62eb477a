// The place on the device of the bit that says whether a link of the scene is alive (CuttingBuffers::links).
#pragma once

#include "sim/scene.hpp"

namespace sinew::sim::lattice {

/// The bits of a link in the words of live links of its ends; 0 where nothing can cut it. One that leads two
/// nodes far is cut with either of those that lead over the particle between, of which ofA and ofOver are the
/// bits.
struct LinkBits {
    std::uint32_t ofA = 0, ofB = 0;
    std::uint32_t over = 0, ofOver = 0;
    bool isCounted = true; ///< whether its strain says something of it alone
};
/// Indices into Scene::distances.
LinkBits linkBits(const Scene& scene, std::size_t distance);

} // namespace sinew::sim::lattice
