// Meshes made from formulas, so that no mesh file has to be shipped: deterministic, closed (but for the
// cloth), in metres.
#pragma once

#include "mesh/triangle_mesh.hpp"

#include <span>
#include <string_view>

namespace sinew::mesh {

/// What generate() knows, in the order in which help texts list them.
struct Shape {
    std::string_view name, description;
};
std::span<const Shape> shapes();

/// Makes the named shape with about `resolution` edges along its longest side (8 to 1024; the number of
/// triangles grows with its square). All are centred on the origin; y is up. Throws std::invalid_argument for
/// an unknown name or a resolution out of range.
TriangleMesh generate(std::string_view name, std::uint32_t resolution = 64);

} // namespace sinew::mesh
