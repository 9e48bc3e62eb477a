// Which skins are the outer faces of bodies on a grid, triangle by triangle: only those can be clipped along
// a cut and closed with its inside.
#pragma once

#include "sim/compile.hpp"
#include "sim/lattice/placement.hpp"

#include <optional>

namespace sinew::sim::surface {

/// Triangles of `skin` as faces of cells of `grid`, which lies in `box`; none unless each of the grid's outer
/// faces is there as two of them, split as its cells are (shaders/glsl/kuhn.glsl), and nothing else.
/// `firstTriangle` is that of the skin among all.
std::optional<std::vector<layout::SkinFace>>
latticeFaces(const Skin& skin, const Grid& grid, const lattice::Box& box, std::uint32_t firstTriangle);

} // namespace sinew::sim::surface
