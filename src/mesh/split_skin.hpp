// Splits the skin of a body that may be cut, so that it hangs on the body's lattice: every triangle lies in
// one cell, give or take a hundredth of one, and the nodes that its corners go with are corners of one of the
// six tetrahedra of that cell. Private to src/mesh: its vectors are Eigen's.
#pragma once

#include "mesh/vector3.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace sinew::mesh {

struct SplitSkin {
    std::vector<Vector3> positions; ///< [cells]; the given ones come first, as they were
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> wholeOf; ///< of each triangle: the given one that it is a part of
    std::vector<std::array<std::int64_t, 3>> anchors; ///< of each vertex: a node about where it is
};

/// `positions` in cell units, from node (0, 0, 0). Neighbours stay neighbours: edges are split once, for both
/// sides.
SplitSkin splitSkin(std::vector<Vector3> positions, std::vector<std::array<std::uint32_t, 3>> triangles);

} // namespace sinew::mesh
