// Surfaces of cuts meet themselves along edges with four triangles and more, where two wedges of material
// touch. Programs that read a file want two.
#pragma once

#include "mesh/triangle_mesh.hpp"

namespace sinew::mesh {

/// Splits, in its middle, every edge that as many triangles run along one way as the other, and more than
/// one: each pair of triangles with material between them gets a middle of its own, all in the same place.
/// Nothing moves, and edges that are open stay so. Returns how many edges were split.
std::size_t splitCrowdedEdges(TriangleMesh& mesh);

} // namespace sinew::mesh
