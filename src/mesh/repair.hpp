// Repairs what keeps a triangle mesh from enclosing a volume: vertices that are equal but for rounding,
// T-junctions, small leftovers, small holes, triangles and parts that face the wrong way.
#pragma once

#include "mesh/triangle_mesh.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace sinew::mesh {

enum class Repair {
    none,  ///< identical vertices are joined, nothing else
    weld,  ///< seams only: near vertices are joined and T-junctions split
    close, ///< also leftovers removed, small holes closed, triangles and parts turned
};
const char* nameOf(Repair how);                          ///< "none", "weld" or "close"
std::optional<Repair> findRepair(std::string_view name); ///< by such a name

/// Vertices nearer than that share of the longest side of the bounding box are one; or nearer than so many
/// roundings of the largest coordinate, where that is more.
inline constexpr double weldTolerance = 1e-5, weldRoundings = 4;
/// A hole is small where its rim is no longer than that share of the sum of the twelve edges of the bounding
/// box of its part: the triangles that hang together with its rim across edges. A hole of three edges may
/// have any size where the part has more than three triangles.
inline constexpr double smallRim = 1.0 / 6;
/// Beyond this share a patch must continue the surface: seen from outside, it may bend from its neighbours by
/// `largestBend` degrees on average along the rim. The lid of a cup bends by 90.
inline constexpr double tinyRim = 1.0 / 50;
inline constexpr double largestBend = 60;

/// A closed chain of open edges that was left.
struct OpenHole {
    std::size_t edges = 0;
    double rim = 0; ///< length [units of the mesh]
    Vec3 middle;    ///< mean of its vertices
};

/// Positions of vertices of the repaired mesh, one for each repair of a kind, ascending by x, y and z.
using Places = std::vector<Vec3>;

/// Positions of two vertices each.
using VertexPairs = std::vector<std::array<Vec3, 2>>;

struct ClosedHole {
    Vec3 place; ///< of a vertex of its rim
    std::size_t edges = 0, triangles = 0;
};

/// A seam between open edges that is wider than what was joined.
struct WideSeam {
    double weld = 0;        ///< what joins it, as given to repair() [units of the mesh]; 0 = there is none
    std::size_t edges = 0;  ///< open edges that are then joined
    VertexPairs pairs = {}; ///< that become one
};

/// Places of repairs, by which those of a part are found (repairsOf).
struct RepairPlaces {
    Places joined, split, removed, turnedTriangles, turnedParts;
    std::vector<ClosedHole> holes;
};

/// The work of repair(), and the faults that it left.
struct Repairs {
    Repair how = Repair::none;
    double tolerance = 0;             ///< for near vertices [units of the mesh]
    std::size_t joinedVertices = 0;   ///< that became one with another
    std::size_t splitEdges = 0;       ///< at T-junctions
    std::size_t removedTriangles = 0; ///< that became empty or double by joining, and leftovers
    std::size_t closedHoles = 0, holeEdges = 0, holeTriangles = 0;
    std::size_t turnedTriangles = 0; ///< to face as their neighbours do
    std::size_t turnedParts = 0;     ///< closed ones that were inside out
    std::size_t openEdges = 0;       ///< left
    std::size_t openHoles = 0;       ///< left
    OpenHole largest;                ///< of the open holes, by its rim
    WideSeam seam;                   ///< left, or closed by lids on both sides of it
    RepairPlaces places;
    bool isAny() const {
        return joinedVertices + splitEdges + removedTriangles + closedHoles + turnedTriangles + turnedParts >
               0;
    }
};

/// Expects a welded mesh and its `defects`, whose counts of edges become those of the result. A step is kept
/// only where it leaves fewer edges that are open or shared by three and more triangles; closed parts are
/// never welded. `weld`: near vertices are those nearer than that [units of the mesh]; 0 = as weldTolerance
/// says. The same mesh gives the same bytes.
TriangleMesh repair(TriangleMesh mesh, Repair how, MeshDefects& defects, Repairs& report, double weld = 0);

/// The repairs in the triangles of `part` alone, which were chosen of the repaired mesh and not moved, and
/// the edges of them that stay open.
Repairs repairsOf(const TriangleMesh& part, const Repairs& whole);

/// A sentence for each thing that was done, with counts, such as "3 holes of 14 edges were closed with 8
/// triangles".
std::vector<std::string> sentencesOf(const Repairs& report);
/// The edges that stay open and their place: "38 boundary edges around 2 holes, the largest with 20 edges and
/// a rim of 0.12 in units of the file around (1, 2, 3)".
std::string openText(const Repairs& report);

} // namespace sinew::mesh
