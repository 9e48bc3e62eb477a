// Inside sinew_mesh: walks the edges of a triangle mesh with all triangles that meet there; measures welded
// meshes.
#pragma once

#include "mesh/triangle_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace sinew::mesh {

/// One side of one triangle: the edge low-high, run forward (low to high) or backward.
struct HalfEdge {
    std::uint32_t low = 0, high = 0, triangle = 0;
    bool isForward = true;
};

/// Calls visit(std::span<const HalfEdge>) once per edge, in order of its vertices; triangles ascend within an
/// edge.
template <typename Visit>
void forEachEdge(const std::vector<std::array<std::uint32_t, 3>>& triangles, const Visit& visit) {
    std::vector<HalfEdge> sides;
    sides.reserve(3 * triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t from = triangles[i][corner], to = triangles[i][(corner + 1) % 3];
            sides.push_back({std::min(from, to), std::max(from, to), i, from < to});
        }
    std::ranges::sort(sides, {}, [](const HalfEdge& side) {
        return std::tuple{side.low, side.high, side.triangle};
    });
    for (auto first = sides.begin(); first != sides.end();) {
        const auto last = std::find_if(first, sides.end(), [&](const HalfEdge& side) {
            return side.low != first->low || side.high != first->high;
        });
        visit(std::span<const HalfEdge>(first, last));
        first = last;
    }
}

/// Turns triangles so that neighbours run the same way round, each connected part the way most of its area
/// already did. Returns how many were turned. Expects a welded mesh.
std::size_t orientNeighbours(TriangleMesh& mesh);

/// What inspect() reports but for the defects. Expects a welded mesh.
MeshReport measure(const TriangleMesh& mesh);

} // namespace sinew::mesh
