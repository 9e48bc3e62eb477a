// Conversion of a link of the scene to its bits in the words of its ends.
#include "sim/lattice/link_bits.hpp"

#include "sim/lattice/link_masks.hpp"

#include <algorithm>
#include <optional>

namespace sinew::sim::lattice {
namespace {

std::array<int, 3> nodeOf(const Grid& grid, std::uint32_t particle) {
    const std::uint32_t node = grid.node[particle - grid.firstParticle];
    return {static_cast<int>(node % grid.nodes[0]), static_cast<int>(node / grid.nodes[0] % grid.nodes[1]),
            static_cast<int>(node / grid.nodes[0] / grid.nodes[1])};
}

// The cuttable grid with both ends of a link; the link need not belong to it.
const Grid* gridOf(const Scene& scene, const DistanceConstraint& link) {
    const auto holds = [&](const Grid& grid) {
        const std::size_t count = grid.node.size();
        return grid.isCuttable && link.a - grid.firstParticle < count && link.b - grid.firstParticle < count;
    };
    const auto grid = std::ranges::find_if(scene.grids, holds);
    return grid == scene.grids.end() ? nullptr : &*grid;
}

// The particle halfway between two nodes; none if no particle is there.
std::optional<std::uint32_t> particleBetween(const Grid& grid, const std::array<int, 3>& a,
                                             const std::array<int, 3>& b) {
    std::array<std::uint32_t, 3> middle{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if ((a[axis] + b[axis]) % 2 != 0) return std::nullopt;
        middle[axis] = static_cast<std::uint32_t>((a[axis] + b[axis]) / 2);
    }
    const std::uint32_t node = middle[0] + grid.nodes[0] * (middle[1] + grid.nodes[1] * middle[2]);
    const auto found = std::ranges::lower_bound(grid.node, node);
    if (found == grid.node.end() || *found != node) return std::nullopt;
    return grid.firstParticle + static_cast<std::uint32_t>(found - grid.node.begin());
}

} // namespace

LinkBits linkBits(const Scene& scene, std::size_t distance) {
    const DistanceConstraint& link = scene.distances[distance];
    const Grid* grid = gridOf(scene, link);
    LinkBits bits{.isCounted = link.restLength > 0};
    if (grid == nullptr) return bits;
    const std::array<int, 3> a = nodeOf(*grid, link.a), b = nodeOf(*grid, link.b);
    const std::array<int, 3> way{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    if (const auto bit = bitOf(way)) {
        bits.ofA = 1u << *bit;
        bits.ofB = 1u << (directionCount - 1 - *bit);
        return bits;
    }
    bits.isCounted = false;
    const auto over = particleBetween(*grid, a, b);
    const auto half = bitOf({way[0] / 2, way[1] / 2, way[2] / 2});
    if (!over || !half) return bits;
    bits.over = *over;
    bits.ofA = bits.ofOver = 1u << *half;
    return bits;
}

} // namespace sinew::sim::lattice
