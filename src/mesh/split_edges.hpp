// Splits non-manifold edges. A surface with cuts touches itself along edges with four triangles and more,
// where two wedges of material meet. Readers of files expect two triangles.
#pragma once

#include "mesh/triangle_mesh.hpp"

namespace sinew::mesh {

/// Splits, at its midpoint, every edge along which equally many triangles, and more than one, run in both
/// directions: each pair of triangles with material between them gets a midpoint vertex of its own, all in
/// the same place. No vertex moves, and open edges stay open. Returns the number of edges split.
std::size_t splitCrowdedEdges(TriangleMesh& mesh);

} // namespace sinew::mesh
