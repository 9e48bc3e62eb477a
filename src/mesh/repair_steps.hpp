// The steps of repair(), each on a welded mesh. A step changes the mesh and appends a place for each change:
// the position of a vertex that stays.
#pragma once

#include "mesh/repair.hpp"
#include "mesh/topology.hpp"

#include <set>

namespace sinew::mesh {

/// An edge with one triangle, which runs from `from` to `to`.
struct OpenEdge {
    std::uint32_t from = 0, to = 0, triangle = 0;
};
std::vector<OpenEdge> findOpenEdges(const TriangleMesh& mesh);
/// Ascending, without repeats.
std::vector<std::uint32_t> verticesOf(const std::vector<OpenEdge>& edges);

/// Joins vertices of open edges that are nearer than `tolerance` to the one of lowest index among them. A
/// triangle whose longest edge is short lends its corners no more than a quarter of that. May leave triangles
/// that are empty or double. A place, and a pair of positions, for each vertex that became another.
void joinNear(TriangleMesh& mesh, double tolerance, Places& places, VertexPairs* pairs = nullptr);

/// Splits triangles at vertices of open edges that lie on their own open edges and whose open edges run along
/// these. A place for each edge split.
void splitJunctions(TriangleMesh& mesh, double tolerance, Places& places);

/// Removes single triangles that stick out of a surface, and walls within a volume: sheets whose whole rim
/// the surface passes without them. A place for each triangle.
void removeLeftovers(TriangleMesh& mesh, Places& places);

/// Closes the small holes, if it `closes`, with an entry of `report` for each; says there what stays open.
void closeHoles(TriangleMesh& mesh, bool closes, Repairs& report);

enum class Across {
    pairs, ///< edges of two triangles
    edges, ///< edges of two triangles and more
};
/// For each triangle the number of its part: what hangs together across such edges.
std::vector<std::uint32_t> numberParts(const TriangleMesh& mesh, std::size_t& count,
                                       Across across = Across::pairs);

/// Turns closed parts that are inside out and lie within no other; parts within these turn with them, so that
/// a cavity stays one. A place for each part that was inside out by itself.
void turnParts(TriangleMesh& mesh, Places& places);

using VertexPair = std::array<std::uint32_t, 2>; ///< the lower first

/// Edges that the mesh has already: a patch may not add a third triangle to one.
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

/// A hole: its vertices in the order in which a patch runs round it, and for each the triangle behind the
/// edge to the next.
struct Loop {
    std::vector<std::uint32_t> vertices, rim;
};

struct Patch {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    double bend = 0;            ///< mean angle to the triangles of the rim, by length [degrees]
    std::optional<Vec3> center; ///< the middle of a fan: the vertex after all of the mesh
};

/// The triangulation that bends least, of those the one of least area; for more than 128 edges a fan. Without
/// triangles where each one would fold over or give an edge a third triangle.
Patch makePatch(const TriangleMesh& mesh, const Loop& loop, const TakenEdges& taken);

} // namespace sinew::mesh
