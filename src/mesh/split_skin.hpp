// Splits the skin of a body that may be cut, so that it can be bound to the body's lattice: every triangle
// lies in one cell, within a hundredth of a cell, and the anchors of its corners are corners of one of the
// six tetrahedra of that cell. Private to src/mesh: its vectors are Eigen's.
#pragma once

#include "mesh/vector3.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace sinew::mesh {

struct SplitSkin {
    std::vector<Vector3> positions; ///< [cells]; the given ones come first, unchanged
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> wholeOf; ///< one per triangle: index of the given one that contains it
    std::vector<std::array<std::int64_t, 3>> anchors; ///< one per vertex: a nearby node
};

/// `positions` in cell units, relative to node (0, 0, 0). Adjacency is kept: edges are split once, for both
/// sides.
SplitSkin splitSkin(std::vector<Vector3> positions, std::vector<std::array<std::uint32_t, 3>> triangles);

} // namespace sinew::mesh
