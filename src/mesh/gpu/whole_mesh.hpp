// A mesh in whole numbers, as the kernels want it: rounded once, so that nothing is rounded later.
#pragma once

#include "mesh/place_grid.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace sinew::mesh::gpu {

/// Coordinates lie in [0, 2^30], 2^fractionBits to a cell; a vertex moves by half a unit at most: 2^-24 cells
/// in a grid of 128 cells, 2^-7 in the longest that there can be.
struct WholeMesh {
    std::uint32_t fractionBits = 0;
    std::vector<std::array<std::int32_t, 4>> vertices;   ///< w unused
    std::vector<std::array<std::uint32_t, 4>> triangles; ///< w unused
    /// Triangles whose rows of cells are counted together. rowStarts: rows of the batch before a triangle.
    struct Batch {
        std::uint32_t first = 0, count = 0, rows = 0;
    };
    std::vector<Batch> batches;
    std::vector<std::uint32_t> rowStarts;
};

WholeMesh toWholeNumbers(const PlacedMesh& placed);

} // namespace sinew::mesh::gpu
