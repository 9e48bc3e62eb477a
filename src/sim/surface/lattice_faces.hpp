// Detection of skins that are the outer faces of bodies on a grid, triangle by triangle: only those can be
// clipped along a cut and closed with the cut surface.
#pragma once

#include "sim/lattice/placement.hpp"
#include "sinew/scene.hpp"

#include <optional>

namespace sinew::sim::surface {

/// Triangles of `skin` as faces of cells of `grid`, placed in `box`. None unless the skin consists of each
/// outer face of the grid as two triangles, split like its cells (shaders/glsl/lattice/kuhn.glsl), and
/// nothing else. `firstTriangle` is the index of the skin's first triangle among all.
std::optional<std::vector<layout::SkinFace>>
latticeFaces(const Skin& skin, const Grid& grid, const lattice::Box& box, std::uint32_t firstTriangle);

} // namespace sinew::sim::surface
