// How deep the nodes of a lattice lie in their body, and which way leads out, at rest.
#pragma once

#include "sim/scene.hpp"

#include <vector>

namespace sinew::sim::lattice {

struct NodeDepth {
    float depth = 0; ///< [m] along links of the grid to the nearest node of the surface; 0 = on the surface
    Vec3 outward;    ///< unit, along the grid's axes; 0 where none is nearer to the outside than another
};

/// Whether all eight cells around a node are filled; `word` as fillAround() says.
bool isInside(std::uint32_t word);

/// Of each particle of the grid, which must not be a sheet.
std::vector<NodeDepth> depthsOf(const Grid& grid);

} // namespace sinew::sim::lattice
