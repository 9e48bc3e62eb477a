// The steps of repair(), each on a welded mesh. A step changes the mesh and appends a place for each change:
// the position of a remaining vertex.
#pragma once

#include "mesh/repair.hpp"
#include "mesh/topology.hpp"

#include <set>

namespace sinew::mesh {

/// An edge with a single triangle, in which it runs from `from` to `to`.
struct OpenEdge {
    std::uint32_t from = 0, to = 0, triangle = 0;
};
std::vector<OpenEdge> findOpenEdges(const TriangleMesh& mesh);
/// Their vertices, ascending, without repeats.
std::vector<std::uint32_t> verticesOf(const std::vector<OpenEdge>& edges);

/// Joins vertices of open edges that are nearer than `tolerance` to the one with the lowest index among them.
/// For a vertex of small triangles the distance is at most a quarter of the longest edge around it. May leave
/// degenerate or duplicate triangles. Adds a place, and a pair of positions, for each joined vertex.
void joinNear(TriangleMesh& mesh, double tolerance, Places& places, VertexPairs* pairs = nullptr);

/// Splits triangles at vertices of open edges that lie on their own open edges and whose open edges run along
/// these. Adds a place for each edge split.
void splitJunctions(TriangleMesh& mesh, double tolerance, Places& places);

/// Removes single triangles that stick out of a surface, and walls within a volume: sheets along whose whole
/// rim the surface continues without them. Adds a place for each triangle.
void removeLeftovers(TriangleMesh& mesh, Places& places);

/// Closes the small holes, if `closes`, with an entry of `report` for each; reports the edges that remain
/// open.
void closeHoles(TriangleMesh& mesh, bool closes, Repairs& report);

enum class Across {
    pairs, ///< edges of two triangles
    edges, ///< edges of two or more triangles
};
/// Index of the part of each triangle; a part is connected across such edges.
std::vector<std::uint32_t> numberParts(const TriangleMesh& mesh, std::size_t& count,
                                       Across across = Across::pairs);

/// Reverses closed parts that are inside out and lie within no other, together with the closed parts inside
/// of them, so that a cavity stays a cavity. Adds a place for each part that was inside out by itself.
void turnParts(TriangleMesh& mesh, Places& places);

using VertexPair = std::array<std::uint32_t, 2>; ///< the lower index first

/// Existing edges: a patch may not add a third triangle to one.
class TakenEdges {
public:
    /// `edges` in any order, with repeats.
    explicit TakenEdges(std::vector<VertexPair> edges);
    void add(std::uint32_t a, std::uint32_t b) { added_.insert({std::min(a, b), std::max(a, b)}); }
    bool has(std::uint32_t a, std::uint32_t b) const;

private:
    std::vector<VertexPair> edges_; ///< ascending
    std::set<VertexPair> added_;
};

/// A hole: its vertices in the direction of a patch's sides, and for each the triangle at the edge to the
/// next one.
struct Loop {
    std::vector<std::uint32_t> vertices, rim;
};

struct Patch {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    double bend = 0;            ///< mean angle to the triangles of the rim, by length [degrees]
    std::optional<Vec3> center; ///< centre of a fan: a new vertex after all vertices of the mesh
};

/// The triangulation with the smallest largest bend, among those the one of least area; a fan for more than
/// 128 edges. Empty if every one would fold over or give an edge a third triangle.
Patch makePatch(const TriangleMesh& mesh, const Loop& loop, const TakenEdges& taken);

} // namespace sinew::mesh
