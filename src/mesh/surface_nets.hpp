// Turns an implicit function into a smooth, even triangle mesh: naive surface nets [Gibson 1998] on a grid,
// then a few rounds of smoothing along the surface with the vertices pulled back onto it.
#pragma once

#include "mesh/triangle_mesh.hpp"
#include "mesh/vector3.hpp"

#include <functional>

namespace sinew::mesh {

/// Negative inside, positive outside; smooth, with a gradient of about 1 near its zero set.
using ImplicitFunction = std::function<double(const Vector3&)>;

/// The zero set of `function` within the box, which must hold it with a cell to spare. `spacing` is the edge
/// of a grid cell and about that of a triangle. Parts and gaps thinner than two cells may join or break.
TriangleMesh isosurface(const ImplicitFunction& function, const Eigen::AlignedBox3d& box, double spacing);

} // namespace sinew::mesh
