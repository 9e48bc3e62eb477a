// Rounding, and the prefix sum over the rows of cells in the triangles' bounding boxes.
#include "mesh/gpu/whole_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sinew::mesh::gpu {
namespace {

constexpr std::uint32_t coordinateBits = 30; ///< differences of products of three then fit in 96 bits
/// Rows of a batch of several triangles; a single triangle has at most as many rows as the grid has cells.
constexpr std::uint64_t mostRows = 1u << 18;

/// Number of rows of cells along x that a triangle's box touches, with cells a unit larger, as in
/// mark_hull.comp.
std::uint32_t rowsOf(const WholeMesh& whole, const std::array<std::uint32_t, 3>& triangle,
                     const std::array<std::uint32_t, 3>& cells) {
    std::uint32_t rows = 1;
    for (std::size_t axis = 1; axis < 3; ++axis) {
        const auto [low, high] =
            std::minmax({whole.vertices[triangle[0]][axis], whole.vertices[triangle[1]][axis],
                         whole.vertices[triangle[2]][axis]});
        const std::int32_t first = std::max((low - 1) >> whole.fractionBits, 0);
        const std::int32_t last =
            std::min((high + 1) >> whole.fractionBits, static_cast<std::int32_t>(cells[axis]) - 1);
        rows *= static_cast<std::uint32_t>(last - first + 1);
    }
    return rows;
}

void countRows(WholeMesh& whole, const PlacedMesh& placed) {
    std::uint64_t rows = mostRows; // rows of the open batch; the first triangle opens one
    for (std::uint32_t t = 0; t < placed.mesh.triangles.size(); ++t) {
        const std::uint32_t own = rowsOf(whole, placed.mesh.triangles[t], placed.grid.cells);
        if (rows + own > mostRows) {
            whole.batches.push_back({.first = t});
            rows = 0;
        }
        whole.rowStarts.push_back(static_cast<std::uint32_t>(rows));
        rows += own;
        whole.batches.back().count += 1;
        whole.batches.back().rows = static_cast<std::uint32_t>(rows);
    }
}

} // namespace

WholeMesh toWholeNumbers(const PlacedMesh& placed) {
    const std::uint32_t longest = *std::ranges::max_element(placed.grid.cells);
    WholeMesh whole{.fractionBits = coordinateBits - static_cast<std::uint32_t>(std::bit_width(longest - 1))};
    const double unitsPerCell = std::exp2(whole.fractionBits);
    whole.vertices.reserve(placed.positions.size());
    for (const Vector3& position : placed.positions) {
        const auto round = [&](Eigen::Index axis) {
            return static_cast<std::int32_t>(std::lround(position[axis] * unitsPerCell));
        };
        whole.vertices.push_back({round(0), round(1), round(2), 0});
    }
    whole.triangles.reserve(placed.mesh.triangles.size());
    whole.rowStarts.reserve(placed.mesh.triangles.size());
    for (const auto& [a, b, c] : placed.mesh.triangles) whole.triangles.push_back({a, b, c, 0});
    countRows(whole, placed);
    return whole;
}

} // namespace sinew::mesh::gpu
