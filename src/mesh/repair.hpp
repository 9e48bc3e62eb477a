// Repair of defects that keep a triangle mesh from enclosing a volume: vertices that are equal up to
// rounding, T-junctions, small leftovers, small holes, triangles and parts with the wrong orientation.
#pragma once

#include "mesh/triangle_mesh.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace sinew::mesh {

enum class Repair {
    none,  ///< only identical vertices are joined
    weld,  ///< seams only: near vertices are joined and T-junctions split
    close, ///< also leftovers removed, small holes closed, triangles and parts reversed
};
const char* nameOf(Repair how);                          ///< "none", "weld" or "close"
std::optional<Repair> findRepair(std::string_view name); ///< the inverse of nameOf()

/// Vertices are joined if nearer than this share of the longest side of the bounding box, or than so many
/// roundings of the largest coordinate, if that is more.
inline constexpr double weldTolerance = 1e-5, weldRoundings = 4;
/// A hole is small if its rim is no longer than this share of the sum of the twelve edges of the bounding box
/// of its part: the triangles connected to its rim across edges. A hole of three edges may have any size if
/// the part has more than three triangles.
inline constexpr double smallRim = 1.0 / 6;
/// Beyond this share a patch must continue the surface: seen from outside, its mean angle to its neighbours
/// along the rim may be at most `largestBend` degrees. The lid of a cup has 90.
inline constexpr double tinyRim = 1.0 / 50;
inline constexpr double largestBend = 60;

/// A closed chain of open edges that remains.
struct OpenHole {
    std::size_t edges = 0;
    double rim = 0; ///< length [units of the mesh]
    Vec3 middle;    ///< mean of its vertices
};

/// Positions of vertices of the repaired mesh, one for each repair of a kind, ascending by x, y and z.
using Places = std::vector<Vec3>;

/// Positions of pairs of vertices.
using VertexPairs = std::vector<std::array<Vec3, 2>>;

struct ClosedHole {
    Vec3 place; ///< position of a vertex of its rim
    std::size_t edges = 0, triangles = 0;
};

/// A seam between open edges that is wider than the welding distance.
struct WideSeam {
    double weld = 0;        ///< value for repair() that joins it [units of the mesh]; 0 = no such seam
    std::size_t edges = 0;  ///< number of open edges that this joins
    VertexPairs pairs = {}; ///< positions of the vertices that it joins
};

/// Places of repairs, which repairsOf() uses to find those of a part.
struct RepairPlaces {
    Places joined, split, removed, turnedTriangles, turnedParts;
    std::vector<ClosedHole> holes;
};

/// Report of repair(): the repairs done, and the faults that remain.
struct Repairs {
    Repair how = Repair::none;
    double tolerance = 0;             ///< welding distance [units of the mesh]
    std::size_t joinedVertices = 0;   ///< vertices joined to another one
    std::size_t splitEdges = 0;       ///< at T-junctions
    std::size_t removedTriangles = 0; ///< degenerate or duplicate after joining, and leftovers
    std::size_t closedHoles = 0, holeEdges = 0, holeTriangles = 0;
    std::size_t turnedTriangles = 0; ///< reversed to agree with their neighbours
    std::size_t turnedParts = 0;     ///< closed parts that were inside out
    std::size_t openEdges = 0;       ///< remaining
    std::size_t openHoles = 0;       ///< remaining
    OpenHole largest;                ///< the open hole with the longest rim
    WideSeam seam;                   ///< remaining, or closed by patches on both of its sides
    RepairPlaces places;
    bool isAny() const {
        return joinedVertices + splitEdges + removedTriangles + closedHoles + turnedTriangles + turnedParts >
               0;
    }
};

/// Repairs a welded mesh with the given `defects`, whose counts of edges become those of the result. A step
/// is kept only if it leaves fewer edges that are open or shared by three and more triangles; closed parts
/// are never welded. `weld`: welding distance [units of the mesh]; 0 = by weldTolerance. The same mesh gives
/// the same bytes.
TriangleMesh repair(TriangleMesh mesh, Repair how, MeshDefects& defects, Repairs& report, double weld = 0);

/// The repairs of the triangles of `part`, which must be a selection of the repaired mesh with unchanged
/// positions, and the edges of the part that remain open.
Repairs repairsOf(const TriangleMesh& part, const Repairs& whole);

/// A sentence for each kind of repair done, with counts, such as "3 holes of 14 edges were closed with 8
/// triangles".
std::vector<std::string> sentencesOf(const Repairs& report);
/// The edges that remain open, and their place: "38 boundary edges around 2 holes, the largest with 20 edges
/// and a rim of 0.12 in units of the file around (1, 2, 3)".
std::string openText(const Repairs& report);

} // namespace sinew::mesh
