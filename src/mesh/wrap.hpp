// A closed surface around what a mesh encloses, for meshes that are open or pass through themselves: an
// inside can be shown along a cut only where a surface says where it ends.
#pragma once

#include "mesh/components.hpp"
#include "mesh/voxelise.hpp"

#include <span>

namespace sinew::mesh {

/// A closed surface that touches itself nowhere, half a cell of `grid` fine, around all that `mesh` encloses.
/// It follows the mesh where the mesh has triangles and bridges its holes where the winding number is a half.
/// Sheets and parts thinner than a cell are in it as if they were a cell thick. `mesh` is welded and
/// oriented, `grid` was filled from it. Empty where the mesh is.
TriangleMesh wrap(const TriangleMesh& mesh, const VoxelGrid& grid);

/// For each component of `mesh` the share of its area that lies outside of the surface around the mesh by
/// more than a fifth of a voxel: what is thinner than a voxel and less than one beside a thicker part is left
/// out. Looks at 64 triangles of each of the first 1000 components.
std::vector<double> leftOut(const TriangleMesh& mesh, std::span<const Component> components,
                            const TriangleMesh& wrapped, double voxel);

} // namespace sinew::mesh
