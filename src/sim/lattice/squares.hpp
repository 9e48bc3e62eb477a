// The squares between four neighbouring particles of a voxel body, as triangles. Each is split along the
// diagonal from its lowest to its highest corner, like the tetrahedra of its cells, so that all edges are
// links.
#pragma once

#include "sinew/scene.hpp"

#include <vector>

namespace sinew::sim::lattice {

/// Outer squares have a filled cell on only one side and face away from it. Inner ones have filled cells on
/// both sides and face the higher cell.
enum class Squares : std::uint8_t { outer, inner };

/// Appends both triangles of every such square of `grid`, which must not be a sheet, as solid faces of the
/// given thickness [m].
void appendSquares(std::vector<Face>& faces, const Grid& grid, float thickness, Squares squares);

} // namespace sinew::sim::lattice
