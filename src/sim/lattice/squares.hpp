// The squares between four neighbouring particles of a voxel body as triangles. Each is split along the
// diagonal from its lowest corner to its highest, as the tetrahedra of its cells are: all edges are links.
#pragma once

#include "sim/scene.hpp"

#include <vector>

namespace sinew::sim::lattice {

/// Outer squares have a filled cell on one side alone and face away from it. Inner ones have one on both
/// sides and face the higher cell.
enum class Squares : std::uint8_t { outer, inner };

/// Appends both halves of every such square of `grid`, which must be no sheet, as solid faces of that
/// thickness [m].
void appendSquares(std::vector<Face>& faces, const Grid& grid, float thickness, Squares squares);

} // namespace sinew::sim::lattice
