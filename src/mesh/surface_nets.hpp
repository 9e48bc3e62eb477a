// Converts an implicit function to a smooth, even triangle mesh: naive surface nets [Gibson 1998] on a grid,
// then a few rounds of smoothing along the surface with the vertices pulled back onto it.
#pragma once

#include "mesh/triangle_mesh.hpp"
#include "mesh/vector3.hpp"

#include <functional>

namespace sinew::mesh {

/// An implicit function, negative inside, positive outside; smooth, with a gradient of about 1 near its zero
/// set.
using ImplicitFunction = std::function<double(const Vector3&)>;

/// The zero set of `function` within the box, which must contain it with a margin of a cell. `spacing` is the
/// edge of a grid cell and roughly that of a triangle. Parts and gaps thinner than two cells may join or
/// break.
TriangleMesh isosurface(const ImplicitFunction& function, const Eigen::AlignedBox3d& box, double spacing);

} // namespace sinew::mesh
