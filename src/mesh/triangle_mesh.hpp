// A plain triangle mesh, its defects and its measures.
#pragma once

#include "sinew/scene.hpp"

namespace sinew::mesh {

using sim::Vec3;

constexpr std::uint32_t noObject = 0xffffffff; ///< in TriangleMesh::objects

struct TriangleMesh {
    std::string name;
    std::vector<Vec3> positions;                         ///< [m]
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< counter-clockwise seen from outside
    /// Index of each triangle's object in `objectNames`, or noObject; empty if no object has a name.
    std::vector<std::uint32_t> objects = {};
    std::vector<std::string> objectNames = {}; ///< names from the file, no two equal
    /// Number of the component that contained each triangle before a selection, from 1; empty without a
    /// selection.
    std::vector<std::uint32_t> parts = {};
    /// Empty, or texture coordinates of the corners of each triangle: a seam needs no second vertex.
    std::vector<sim::TextureCorners> textureCoordinates = {};
};

/// Reverses a triangle, with its texture coordinates.
void flip(TriangleMesh& mesh, std::size_t triangle);

/// Topology and quality of a mesh after identical vertices were joined.
struct MeshDefects {
    std::size_t boundaryEdges = 0;       ///< edges with one triangle: the mesh is open
    std::size_t nonManifoldEdges = 0;    ///< edges with three or more
    std::size_t flippedEdges = 0;        ///< edges whose two triangles have opposite orientations
    std::size_t degenerateTriangles = 0; ///< dropped: zero area or a repeated vertex
    std::size_t duplicateTriangles = 0;  ///< dropped
    bool isClosed() const { return boundaryEdges == 0 && nonManifoldEdges == 0; }
};

struct MeshReport {
    MeshDefects defects;
    double volume = 0; ///< signed, by the divergence theorem [m^3]; meaningful for closed meshes
    double area = 0;   ///< [m^2]
    Vec3 low, high;    ///< bounding box [m]
};

/// The report of inspect() without the defects. Expects a welded mesh.
MeshReport measure(const TriangleMesh& mesh);

/// Topology as after weld(); `mesh` itself may contain duplicate vertices.
MeshReport inspect(const TriangleMesh& mesh);

/// Joins vertices with identical positions, and drops degenerate triangles, duplicates (the same corners in
/// the same orientation) and vertices that no triangle uses. Sets `defects` to what was found. Keeps the
/// order of the rest, so that a second weld changes nothing. Appends to `dropped`, if not null, the position
/// of a corner of each dropped triangle.
TriangleMesh weld(const TriangleMesh& mesh, MeshDefects& defects, std::vector<Vec3>* dropped = nullptr);

/// The triangles marked true, their objects, and the vertices that they use, all in the order of `mesh`.
TriangleMesh keep(const TriangleMesh& mesh, const std::vector<bool>& isKept);

/// Reverses triangles so that neighbours have the same orientation: each connected part gets that of most of
/// its area, then all are reversed if needed so that the volume is not negative. Expects a welded mesh.
TriangleMesh orient(TriangleMesh mesh);

} // namespace sinew::mesh
