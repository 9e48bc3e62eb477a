// Meshes made from formulas, so that no mesh files have to be shipped: deterministic, closed (except the
// cloth), in metres.
#pragma once

#include "mesh/triangle_mesh.hpp"

#include <span>
#include <string_view>

namespace sinew::mesh {

/// A shape that generate() knows, in the order of the help texts.
struct Shape {
    std::string_view name, description;
};
std::span<const Shape> shapes();

/// Makes the named shape with about `resolution` edges along its longest side (8 to 256; the number of
/// triangles grows with its square). All are centred on the origin; y is up. Throws std::invalid_argument for
/// an unknown name or a resolution out of range.
TriangleMesh generate(std::string_view name, std::uint32_t resolution = 64);

} // namespace sinew::mesh
