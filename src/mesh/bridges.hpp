// Components of a mesh that its voxels join into one body.
#pragma once

#include "mesh/components.hpp"
#include "mesh/voxelise.hpp"

#include <array>
#include <string>
#include <vector>

namespace sinew::mesh {

struct Bridges {
    std::size_t components = 0;         ///< that share connected voxels with another one; 0 = none is joined
    double gap = 0;                     ///< the least distance of two of them that do not touch [m]
    std::array<std::string, 2> nearest; ///< the names of these two
    std::vector<std::array<std::string, 2>> overlaps; ///< names of pairs that meet or lie in each other
};

/// Tells which components of a mesh share connected voxels of `grid`, which was filled from it, though their
/// surfaces neither touch nor reach into each other, and which do. Voxels that share a corner are connected,
/// since they share a particle; what is farther than two diagonals of a voxel apart is not joined by them.
/// Looks at the 16 largest components that are connected; distances are from points on the edges.
Bridges findBridges(const TriangleMesh& mesh, const std::vector<Component>& components,
                    const VoxelGrid& grid);

} // namespace sinew::mesh
