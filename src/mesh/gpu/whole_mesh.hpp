// A mesh in integer coordinates for the kernels: rounded once, so that nothing is rounded later.
#pragma once

#include "mesh/place_grid.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace sinew::mesh::gpu {

/// Coordinates are in [0, 2^30], 2^fractionBits to a cell; rounding moves a vertex by half a unit at most:
/// 2^-24 cells in a grid of 128 cells, 2^-7 in the longest possible grid.
struct WholeMesh {
    std::uint32_t fractionBits = 0;
    std::vector<std::array<std::int32_t, 4>> vertices;   ///< w unused
    std::vector<std::array<std::uint32_t, 4>> triangles; ///< w unused
    /// Triangles whose rows of cells are numbered together. rowStarts: number of rows of the batch before a
    /// triangle.
    struct Batch {
        std::uint32_t first = 0, count = 0, rows = 0;
    };
    std::vector<Batch> batches;
    std::vector<std::uint32_t> rowStarts;
};

WholeMesh toWholeNumbers(const PlacedMesh& placed);

} // namespace sinew::mesh::gpu
