// Depth of the nodes of a lattice below the surface of their body, and the direction to the outside, at rest.
#pragma once

#include "sinew/scene.hpp"

#include <vector>

namespace sinew::sim::lattice {

struct NodeDepth {
    float depth = 0; ///< [m] along links of the grid to the nearest surface node; 0 = on the surface
    Vec3 outward;    ///< unit vector in the grid's axes; 0 if no direction is nearer to the outside
};

/// Whether all eight cells around a node are filled; `word` is fillAround() of it.
bool isInside(std::uint32_t word);

/// One for each particle of the grid, which must not be a sheet.
std::vector<NodeDepth> depthsOf(const Grid& grid);

} // namespace sinew::sim::lattice
