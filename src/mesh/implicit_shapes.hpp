// Shapes as implicit functions, negative inside, which generate() converts to meshes by surface nets.
#pragma once

#include "mesh/vector3.hpp"

namespace sinew::mesh {

/// A liver: two lobes with a notch between them, a hollow underside, a gall bladder. About 0.3 m long; y is
/// up.
double organDistance(const Vector3& x);

/// A slab of 0.3 x 0.06 x 0.2 m with rounded edges and a hole of radius 0.05 m through its middle, along y.
double slabDistance(const Vector3& x);

} // namespace sinew::mesh
