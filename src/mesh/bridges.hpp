// Components of a mesh that its voxels join into one body.
#pragma once

#include "mesh/components.hpp"
#include "mesh/voxelise.hpp"

namespace sinew::mesh {

struct Bridges {
    std::size_t components = 0; ///< that share connected voxels with another one; 0 = none is joined
    double gap = 0;             ///< the least distance of two of them that do not touch [m]
};

/// Tells which components of a mesh share connected voxels of `grid`, which was filled from it, though their
/// surfaces neither touch nor reach into each other. Voxels that share a corner are connected, since they
/// share a particle. Looks at the 16 largest components that are joined; distances are from vertices.
Bridges findBridges(const TriangleMesh& mesh, const std::vector<Component>& components,
                    const VoxelGrid& grid);

} // namespace sinew::mesh
