// Wall thickness of a mesh.
#pragma once

#include "mesh/triangle_mesh.hpp"

namespace sinew::mesh {

/// The thickness below which `share` of the surface is [m]: along the inward normal to an opposite side that
/// is parallel within 45 degrees. Infinite if a smaller share has such a side. Uses 2000 points, always the
/// same. Expects a welded mesh.
double wallThickness(const TriangleMesh& mesh, double share);

} // namespace sinew::mesh
