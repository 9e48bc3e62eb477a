// A grid repeats the lists of particles and constraints, so that a solver may compute it; this file checks
// that both agree.
#include "sim/lattice/check_grid.hpp"

#include "sim/lattice/placement.hpp"
#include "sinew/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

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

/// A step to a neighbour is a code from 0 to 26: x + 1 + 3 (y + 1) + 9 (z + 1).
constexpr std::uint32_t stepCount = 27;

constexpr int along(std::uint32_t step, std::uint32_t axis) {
    return static_cast<int>(step / (axis == 0 ? 1 : axis == 1 ? 3 : 9) % 3) - 1;
}

/// 1 for an edge, 2 for a face diagonal, 3 for a body diagonal.
constexpr std::uint32_t axesOf(std::uint32_t step) {
    std::uint32_t axes = 0;
    for (std::uint32_t axis = 0; axis < 3; ++axis) axes += along(step, axis) != 0 ? 1 : 0;
    return axes;
}

/// The cells of fillAround(a) that contain the link from a to its neighbour one step away.
constexpr std::array<std::uint32_t, stepCount> cellsOfSteps = [] {
    std::array<std::uint32_t, stepCount> cells{};
    for (std::uint32_t step = 0; step < stepCount; ++step)
        for (std::uint32_t k = 0; k < 8; ++k) {
            bool isHeld = true;
            for (std::uint32_t axis = 0; axis < 3; ++axis)
                isHeld = isHeld && along(step, axis) != ((k >> axis & 1) == 0 ? 1 : -1);
            if (isHeld) cells[step] |= 0xfu << 4 * k;
        }
    return cells;
}();

std::optional<std::uint32_t> stepBetween(const Node& a, const Node& b) {
    std::uint32_t step = 0;
    for (std::size_t axis = 3; axis-- > 0;) {
        const std::uint32_t from = b[axis] - a[axis] + 1; // wraps to a large number if b is too far
        if (from > 2) return std::nullopt;
        step = 3 * step + from;
    }
    return step;
}

/// Mean fill of the cells that can contain a link [0..1], for sheets the largest.
double heldBy(const Grid& grid, std::uint32_t fillAround, std::uint32_t step) {
    std::uint32_t sum = 0, most = 0;
    for (std::uint32_t rest = fillAround & cellsOfSteps[step]; rest != 0; rest >>= 4) {
        sum += rest & 0xf;
        most = std::max(most, rest & 0xf);
    }
    if (isSheet(grid)) return most / double{LATTICE_FULL};
    const std::uint32_t cells = 8u >> axesOf(step);
    return sum / (double{LATTICE_FULL} * cells);
}

/// The node of a particle of the grid, and the fill of the cells around it.
struct Place {
    Node node;
    std::uint32_t fillAround;
};

std::vector<Place> placesOf(const Grid& grid) {
    std::vector<Place> places;
    places.reserve(grid.node.size());
    for (const std::uint32_t index : grid.node) {
        const Node node = coordinates(grid, index);
        places.push_back({node, fillAround(grid, node)});
    }
    return places;
}

/// Whether every corner of every filled cell is a particle: the corners then count each cell 8 times, 4 times
/// in a sheet.
bool hasAllCorners(const Grid& grid, const std::vector<Place>& places) {
    std::size_t seen = 0;
    for (const Place& place : places)
        for (std::uint32_t rest = place.fillAround; rest != 0; rest >>= 4) seen += (rest & 0xf) != 0 ? 1 : 0;
    const auto filled = static_cast<std::size_t>(std::ranges::count_if(grid.fill, std::identity()));
    return seen == filled * (isSheet(grid) ? 4 : 8);
}

/// The step of `link` from a to b, if the grid has an equal link there.
std::optional<std::uint32_t> stepOf(const Grid& grid, const DistanceConstraint& link, const Place& a,
                                    const Place& b) {
    const std::optional<std::uint32_t> step = stepBetween(a.node, b.node);
    if (!step) return std::nullopt;
    const std::uint32_t axes = axesOf(*step);
    if (axes == 0 || axes > grid.kinds) return std::nullopt;
    const double held = heldBy(grid, a.fillAround, *step);
    if (held == 0 || link.restLength != grid.restLength[axes - 1]) return std::nullopt;
    const double compliance = double{grid.compliance[axes - 1]} / held;
    const bool agrees = std::abs(double{link.compliance} - compliance) <= 1e-5 * compliance;
    return agrees ? step : std::nullopt;
}

/// Number of links that the fill of the cells requires; all corners of filled cells are particles.
std::size_t countLinks(const Grid& grid, const std::vector<Place>& places) {
    std::size_t links = 0;
    for (std::uint32_t step = 0; step < stepCount; ++step) {
        const std::uint32_t axes = axesOf(step);
        if (axes == 0 || axes > grid.kinds || (isSheet(grid) && along(step, 1) != 0)) continue;
        for (const Place& place : places) links += (place.fillAround & cellsOfSteps[step]) != 0 ? 1 : 0;
    }
    return links / 2;
}

} // namespace

std::optional<std::string> complaintAbout(const Scene& scene, const Grid& grid) {
    if (auto complaint = checkShape(scene, grid)) return complaint;
    const std::vector<Place> places = placesOf(grid);
    if (!hasAllCorners(grid, places)) return "has a filled cell with a corner that is no particle";
    std::vector<std::uint32_t> isListed(places.size()); // by step, at the first end
    for (std::uint32_t c = grid.firstDistance; c < grid.firstDistance + grid.distanceCount; ++c) {
        const DistanceConstraint& link = scene.distances[c];
        if (std::max(link.a, link.b) >= scene.particles.size()) return std::nullopt;
        // a large number for a particle before the first
        const auto [first, last] =
            std::minmax({std::size_t{link.a} - grid.firstParticle, std::size_t{link.b} - grid.firstParticle});
        const auto step =
            last < places.size() ? stepOf(grid, link, places[first], places[last]) : std::nullopt;
        if (!step || (isListed[first] >> *step & 1) != 0)
            return "distance[" + std::to_string(c) +
                   "] is not the link that the grid has there: remove the grid from scene.grids or fix one "
                   "of the two";
        isListed[first] |= 1u << *step;
    }
    const std::size_t links = countLinks(grid, places);
    if (links != grid.distanceCount)
        return "has " + std::to_string(links) + " links, but names " + std::to_string(grid.distanceCount) +
               " distance constraints";
    return std::nullopt;
}

} // namespace sinew::sim::lattice
