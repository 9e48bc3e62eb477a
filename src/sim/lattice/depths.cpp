// Depths are shortest paths over the 26 neighbours of a node (Dijkstra); directions are those of falling
// depth.
#include "sim/lattice/depths.hpp"

#include "sim/lattice/placement.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace sinew::sim::lattice {

namespace {

using Node = std::array<std::int64_t, 3>;

class Depths {
public:
    explicit Depths(const Grid& grid)
        : grid_(grid), depth_(std::size_t{grid.nodes[0]} * grid.nodes[1] * grid.nodes[2], nowhere) {
        for (const std::uint32_t node : grid.node) {
            const bool isDeep = isInside(fillAround(grid, coordinates(grid, node)));
            depth_[node] = isDeep ? far : 0;
            if (!isDeep) queue_.push({0, node});
        }
        while (!queue_.empty()) {
            const auto [depth, node] = queue_.top();
            queue_.pop();
            if (depth == depth_[node]) visitAround(depth, node);
        }
    }

    NodeDepth at(std::uint32_t node) const {
        const double spacing = double{grid_.restLength[0]};
        const std::array<double, 3> way = depth_[node] > 0 ? falling(node) : empty(node);
        const double length = std::hypot(way[0], way[1], way[2]);
        NodeDepth result{static_cast<float>(depth_[node] * spacing), {}};
        if (length > 1e-6)
            result.outward = {static_cast<float>(way[0] / length), static_cast<float>(way[1] / length),
                              static_cast<float>(way[2] / length)};
        return result;
    }

private:
    static constexpr double nowhere = -1, far = std::numeric_limits<double>::max();

    // -1 outside the grid and at nodes without a particle
    double depthAt(const Node& at) const {
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (at[axis] < 0 || at[axis] >= std::int64_t{grid_.nodes[axis]}) return nowhere;
        return depth_[indexOf(at)];
    }

    std::size_t indexOf(const Node& at) const {
        return static_cast<std::size_t>(at[0] + std::int64_t{grid_.nodes[0]} *
                                                    (at[1] + std::int64_t{grid_.nodes[1]} * at[2]));
    }

    Node nodeOf(std::uint32_t node) const {
        const auto at = coordinates(grid_, node);
        return {at[0], at[1], at[2]};
    }

    void visitAround(double depth, std::uint32_t node) {
        const Node at = nodeOf(node);
        for (std::int64_t n = 0; n < 27; ++n) {
            const Node step{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
            const Node next{at[0] + step[0], at[1] + step[1], at[2] + step[2]};
            const double way =
                depth + std::sqrt(double(step[0] * step[0] + step[1] * step[1] + step[2] * step[2]));
            if (way >= depthAt(next)) continue;
            depth_[indexOf(next)] = way;
            queue_.push({way, static_cast<std::uint32_t>(indexOf(next))});
        }
    }

    // Direction of falling depth. All neighbours of an inner node exist.
    std::array<double, 3> falling(std::uint32_t node) const {
        std::array<double, 3> way{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Node before = nodeOf(node), after = before;
            --before[axis];
            ++after[axis];
            way[axis] = depthAt(before) - depthAt(after);
        }
        return way;
    }

    // Direction away from the filled cells.
    std::array<double, 3> empty(std::uint32_t node) const {
        const std::uint32_t word = fillAround(grid_, coordinates(grid_, node));
        std::array<double, 3> way{};
        for (std::uint32_t k = 0; k < 8; ++k)
            for (std::uint32_t axis = 0; axis < 3; ++axis)
                if ((word >> 4 * k & 15) != 0) way[axis] += (k >> axis & 1) != 0 ? -1 : 1;
        return way;
    }

    using Visit = std::pair<double, std::uint32_t>;
    const Grid& grid_;
    std::vector<double> depth_; // of nodes [cells]
    std::priority_queue<Visit, std::vector<Visit>, std::greater<>> queue_;
};

} // namespace

bool isInside(std::uint32_t word) {
    for (std::uint32_t k = 0; k < 8; ++k)
        if ((word >> 4 * k & 15) == 0) return false;
    return true;
}

std::vector<NodeDepth> depthsOf(const Grid& grid) {
    const Depths depths(grid);
    std::vector<NodeDepth> result;
    for (const std::uint32_t node : grid.node) result.push_back(depths.at(node));
    return result;
}

} // namespace sinew::sim::lattice
