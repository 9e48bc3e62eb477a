// Bridges: components of a mesh that its voxels join into one body.
#pragma once

#include "mesh/components.hpp"
#include "mesh/voxelise.hpp"

#include <array>
#include <string>
#include <vector>

namespace sinew::mesh {

struct Bridges {
    std::size_t components = 0;         ///< number that share connected voxels with another one; 0 = none
    double gap = 0;                     ///< least distance between two of them that do not touch [m]
    std::array<std::string, 2> nearest; ///< names of the two with that distance
    std::vector<std::array<std::string, 2>> overlaps; ///< names of pairs that intersect or contain each other
};

/// Finds components of a mesh whose surfaces neither touch nor reach into each other, but that share
/// connected voxels of `grid`, which was filled from the mesh; and pairs that do overlap. Voxels that share a
/// corner are connected, since they share a particle; components farther apart than two diagonals of a voxel
/// are never joined. Compares the 16 largest connected components; distances are from points on the edges.
Bridges findBridges(const TriangleMesh& mesh, const std::vector<Component>& components,
                    const VoxelGrid& grid);

} // namespace sinew::mesh
