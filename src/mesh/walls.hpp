// How thick the walls of a mesh are.
#pragma once

#include "mesh/triangle_mesh.hpp"

namespace sinew::mesh {

/// The thickness that `share` of the surface falls below [m]: along the inward normal to an opposite side
/// that is parallel within 45 degrees. Infinite where less than that share has such a side. Looks at 2000
/// points, the same ones each time. Expects a welded mesh.
double wallThickness(const TriangleMesh& mesh, double share);

} // namespace sinew::mesh
