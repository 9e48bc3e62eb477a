// A grid repeats what the lists say, so that a solver may compute it: here the two must agree.
#include "sim/lattice/check_grid.hpp"

#include "sim/lattice/placement.hpp"
#include "sim/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace sinew::sim::lattice {

namespace {

using Node = std::array<std::uint32_t, 3>;

std::optional<std::string> checkShape(const Scene& scene, const Grid& grid) {
    double nodes = 1;
    for (const std::uint32_t count : grid.nodes) nodes *= count;
    if (grid.nodes[0] < 2 || grid.nodes[1] < 1 || grid.nodes[2] < 2 || nodes > 0x7fffffff)
        return "must have at least 2 x 1 x 2 nodes and at most 2^31";
    const double cells =
        double(grid.nodes[0] - 1) * (isSheet(grid) ? 1 : grid.nodes[1] - 1) * (grid.nodes[2] - 1);
    if (static_cast<double>(grid.fill.size()) != cells) return "must have one fill for each cell";
    if (std::ranges::any_of(grid.fill, [](std::uint8_t fill) { return fill > LATTICE_FULL; }))
        return "has a fill above 15";
    if (grid.node.empty() || grid.node.back() >= nodes ||
        std::ranges::adjacent_find(grid.node, std::greater_equal<>()) != grid.node.end())
        return "must have ascending nodes within the grid";
    if (grid.firstParticle + grid.node.size() > scene.particles.size())
        return "names particles that do not exist";
    if (std::size_t{grid.firstDistance} + grid.distanceCount > scene.distances.size())
        return "names distance constraints that do not exist";
    if (grid.kinds != 2 && grid.kinds != 3) return "must have 2 or 3 kinds of links";
    return std::nullopt;
}

/// Mean fill of the cells that may hold the link from `a` to `b` [0..1], for sheets the largest.
double heldBy(const Grid& grid, const Node& a, const Node& b) {
    int sum = 0, count = 0, most = 0;
    const bool sheet = isSheet(grid);
    const std::int64_t cells[3] = {std::int64_t{grid.nodes[0]} - 1,
                                   sheet ? 1 : std::int64_t{grid.nodes[1]} - 1,
                                   std::int64_t{grid.nodes[2]} - 1};
    for (int k = 0; k < 8; ++k) { // cells that have both ends as corners
        std::int64_t cell[3];
        bool isHeld = true, exists = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::int64_t low = std::min(a[axis], b[axis]);
            const bool isLow = (k >> axis & 1) == 0;
            if (sheet && axis == 1) {
                isHeld = isHeld && isLow;
                cell[axis] = 0;
                continue;
            }
            isHeld = isHeld && (a[axis] == b[axis] || !isLow);
            cell[axis] = a[axis] == b[axis] && isLow ? low - 1 : low;
            exists = exists && cell[axis] >= 0 && cell[axis] < cells[axis];
        }
        if (!isHeld) continue;
        ++count;
        const int fill =
            exists ? grid.fill[static_cast<std::size_t>(cell[0] + cells[0] * (cell[1] + cells[1] * cell[2]))]
                   : 0;
        sum += fill;
        most = std::max(most, fill);
    }
    return sheet ? most / double{LATTICE_FULL} : sum / (double{LATTICE_FULL} * count);
}

/// 1 to 3 for neighbours that differ in that many coordinates, 0 for any other two nodes.
std::uint32_t axesBetween(const Node& a, const Node& b) {
    std::uint32_t axes = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t step = std::int64_t{a[axis]} - b[axis];
        if (std::abs(step) > 1) return 0;
        axes += step != 0 ? 1 : 0;
    }
    return axes;
}

bool agrees(const Grid& grid, const DistanceConstraint& link, const Node& a, const Node& b) {
    const std::uint32_t axes = axesBetween(a, b);
    if (axes == 0 || axes > grid.kinds) return false;
    const double held = heldBy(grid, a, b);
    if (held == 0 || link.restLength != grid.restLength[axes - 1]) return false;
    const double compliance = double{grid.compliance[axes - 1]} / held;
    return std::abs(double{link.compliance} - compliance) <= 1e-5 * compliance;
}

/// Links that the fill of the cells calls for.
std::size_t countLinks(const Grid& grid) {
    std::vector<bool> isLive(std::size_t{grid.nodes[0]} * grid.nodes[1] * grid.nodes[2]);
    for (const std::uint32_t node : grid.node) isLive[node] = true;
    std::size_t links = 0;
    for (const std::uint32_t node : grid.node) {
        const Node a = coordinates(grid, node);
        for (int k = 0; k < 27; ++k) {
            const std::int64_t x = std::int64_t{a[0]} + k % 3 - 1, y = std::int64_t{a[1]} + k / 3 % 3 - 1,
                               z = std::int64_t{a[2]} + k / 9 - 1;
            if (x < 0 || y < 0 || z < 0 || x >= grid.nodes[0] || y >= grid.nodes[1] || z >= grid.nodes[2])
                continue;
            const Node b{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                         static_cast<std::uint32_t>(z)};
            const std::uint32_t axes = axesBetween(a, b);
            if (axes == 0 || axes > grid.kinds || heldBy(grid, a, b) == 0) continue;
            links += isLive[b[0] + std::size_t{grid.nodes[0]} * (b[1] + std::size_t{grid.nodes[1]} * b[2])]
                         ? 1
                         : 2;
        }
    }
    return links / 2;
}

} // namespace

std::optional<std::string> complaintAbout(const Scene& scene, const Grid& grid) {
    if (auto complaint = checkShape(scene, grid)) return complaint;
    const std::size_t endParticle = grid.firstParticle + grid.node.size();
    for (std::uint32_t c = grid.firstDistance; c < grid.firstDistance + grid.distanceCount; ++c) {
        const DistanceConstraint& link = scene.distances[c];
        if (std::max(link.a, link.b) >= scene.particles.size()) return std::nullopt;
        const bool isInside =
            std::min(link.a, link.b) >= grid.firstParticle && std::max(link.a, link.b) < endParticle;
        if (!isInside || !agrees(grid, link, coordinates(grid, grid.node[link.a - grid.firstParticle]),
                                 coordinates(grid, grid.node[link.b - grid.firstParticle])))
            return "distance[" + std::to_string(c) +
                   "] is not the link that the grid has there: remove the grid from scene.grids or mend one "
                   "of the two";
    }
    if (countLinks(grid) != grid.distanceCount)
        return "has " + std::to_string(countLinks(grid)) + " links, but names " +
               std::to_string(grid.distanceCount) + " distance constraints";
    return std::nullopt;
}

} // namespace sinew::sim::lattice
