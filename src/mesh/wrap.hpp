// A closed surface around the region that a mesh encloses, for meshes that are open or intersect themselves:
// the inside can be shown along a cut only if a closed surface bounds it.
#pragma once

#include "mesh/voxelise.hpp"

namespace sinew::mesh {

/// A closed surface without self-contact, half a cell of `grid` fine, around all that `mesh` encloses. It
/// follows the mesh where the mesh has triangles and bridges its holes where the winding number is a half.
/// Sheets and components thinner than a cell appear as if they were a cell thick, so that they may merge with
/// others less than half a cell away. `mesh` must be welded and oriented, `grid` filled from it. Empty if the
/// mesh is.
TriangleMesh wrap(const TriangleMesh& mesh, const VoxelGrid& grid);

} // namespace sinew::mesh
