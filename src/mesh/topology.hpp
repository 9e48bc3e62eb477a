// Internal to sinew_mesh: visits the edges of a triangle mesh with all triangles that meet there.
#pragma once

#include "mesh/triangle_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew::mesh {

/// One side of one triangle: the edge low-high, traversed forward (low to high) or backward.
struct HalfEdge {
    std::uint32_t low = 0, high = 0, triangle = 0;
    bool isForward = true;
};

/// All sides of all triangles, sorted by `low`, `high` and `triangle`.
std::vector<HalfEdge> sortedSides(const std::vector<std::array<std::uint32_t, 3>>& triangles);

/// Calls visit(std::span<const HalfEdge>) once per edge of sorted sides, in order of its vertices; triangles
/// ascend within an edge.
template <typename Visit> void forEachEdge(const std::vector<HalfEdge>& sides, const Visit& visit) {
    for (auto first = sides.begin(); first != sides.end();) {
        const auto last = std::find_if(first, sides.end(), [&](const HalfEdge& side) {
            return side.low != first->low || side.high != first->high;
        });
        visit(std::span<const HalfEdge>(first, last));
        first = last;
    }
}
template <typename Visit>
void forEachEdge(const std::vector<std::array<std::uint32_t, 3>>& triangles, const Visit& visit) {
    forEachEdge(sortedSides(triangles), visit);
}

/// Reverses triangles so that neighbours have the same orientation; each connected part gets that of most of
/// its area. Returns the number of reversed triangles. Expects a welded mesh.
std::size_t orientNeighbours(TriangleMesh& mesh);

} // namespace sinew::mesh
