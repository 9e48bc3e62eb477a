// The first step of every voxelisation: a mesh without harmful defects, the grid around it, and its vertices
// in cell units. Private to src/mesh: its vectors are Eigen's.
#pragma once

#include "mesh/vector3.hpp"
#include "mesh/voxelise.hpp"

namespace sinew::mesh {

struct PlacedMesh {
    TriangleMesh mesh;              ///< welded and oriented
    VoxelGrid grid;                 ///< empty, centred on the mesh
    std::vector<Vector3> positions; ///< [cells] from the grid's low corner, all within the grid
};

/// Throws as voxelise().
PlacedMesh placeGrid(const TriangleMesh& mesh, const VoxelRequest& request);

/// Vertices in cell units, 0 at the low corner of the grid.
std::vector<Vector3> toCellUnits(const TriangleMesh& mesh, const VoxelGrid& grid);

} // namespace sinew::mesh
