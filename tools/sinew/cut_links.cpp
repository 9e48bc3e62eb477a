// A link that lies in no body that may be cut has no bits, and is alive.
#include "sinew/cut_links.hpp"

#include "sim/lattice/link_bits.hpp"

namespace sinew::tools {

std::vector<bool> cutLinks(const sim::Scene& scene, std::span<const std::uint32_t> slot,
                           std::span<const std::uint32_t> links) {
    std::vector<bool> isCut;
    isCut.reserve(scene.distances.size());
    for (std::size_t d = 0; d < scene.distances.size(); ++d) {
        const sim::lattice::LinkBits bits = sim::lattice::linkBits(scene, d);
        isCut.push_back((bits.ofA & ~links[slot[scene.distances[d].a]]) != 0 ||
                        (bits.ofOver & ~links[slot[bits.over]]) != 0);
    }
    return isCut;
}

} // namespace sinew::tools
