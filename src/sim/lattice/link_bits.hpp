// Location on the device of the bit that says whether a link of the scene is alive (CuttingBuffers::links).
#pragma once

#include "sinew/scene.hpp"

namespace sinew::sim::lattice {

/// The bits of a link in the words of live links of its ends; 0 if nothing can cut it. A link over two nodes
/// is cut with either of the two links over the particle between; ofA and ofOver are the bits of these.
struct LinkBits {
    std::uint32_t ofA = 0, ofB = 0;
    std::uint32_t over = 0, ofOver = 0;
    bool isCounted = true; ///< whether its strain is that of this link alone
};
/// `distance` is an index into Scene::distances.
LinkBits linkBits(const Scene& scene, std::size_t distance);

} // namespace sinew::sim::lattice
