// A closed surface around what a mesh encloses, for meshes that are open or pass through themselves: an
// inside can be shown along a cut only where a surface says where it ends.
#pragma once

#include "mesh/voxelise.hpp"

namespace sinew::mesh {

/// A closed surface that touches itself nowhere, half a cell of `grid` fine, around all that `mesh` encloses.
/// It follows the mesh where the mesh has triangles and bridges its holes where the winding number is a half.
/// Sheets and components thinner than a cell are in it as if they were a cell thick, so that those may run
/// together with what is less than half a cell beside them. `mesh` is welded and
/// oriented, `grid` was filled from it. Empty where the mesh is.
TriangleMesh wrap(const TriangleMesh& mesh, const VoxelGrid& grid);

} // namespace sinew::mesh
