// Placement of bodies on a grid in the state of a solver: each has a dense box of slots, so that a kernel
// computes neighbours instead of reading them. Between the boxes are rims of slots that no kernel writes:
// kernels read one slice, row and node beyond a box.
#pragma once

#include "common/layout.h"
#include "sinew/scene.hpp"

#include <span>
#include <vector>

namespace sinew::sim::lattice {

/// The box of one grid. Slices are adjacent in memory, so that a march along z reads consecutive memory; rows
/// of all slices are farther apart. (In the opposite order the slices of 64^3 are a power of two apart and
/// evict each other from a CPU's cache.) Padded to even counts in x and y, sheets to multiples of four in x,
/// so that blocks of columns never leave the box.
struct Box {
    std::uint32_t rowStride = 0, sliceStride = 0; ///< distance in slots between neighbours in y, in z
    std::uint32_t slots = 0;                      ///< without the rim
    std::uint32_t origin = 0;                     ///< slot of node (0, 0, 0)
    std::uint32_t end = 0;                        ///< one past the rim

    std::uint32_t slot(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        return origin + x + rowStride * y + sliceStride * z;
    }
};

inline bool isSheet(const Grid& grid) {
    return grid.nodes[1] == 1;
}

/// The box of `grid` with its rim, starting at slot `first`.
Box place(const Grid& grid, std::uint32_t first);

/// Grid coordinates of a node index.
std::array<std::uint32_t, 3> coordinates(const Grid& grid, std::uint32_t node);

/// Fill of the eight cells around a node in 1/15, 4 bits each, cell k on the side (k & 1, k >> 1 & 1, k >> 2)
/// of the node; 0 outside the grid. A sheet has one layer of cells, on the lower side of its nodes in y.
std::uint32_t fillAround(const Grid& grid, const std::array<std::uint32_t, 3>& node);

/// Writes fillAround() of every node, which gather_lattice.comp reads, into `words` by slot.
void writeCells(const Grid& grid, const Box& box, std::span<std::uint32_t> words);

/// The columns of `grid` divided into runs of at most `longest` slices with particles; empty space has no
/// chunks. Blocks have columnsX x columnsY columns; neighbours in x are consecutive.
std::vector<layout::LatticeChunk> chunksOf(const Grid& grid, const Box& box, std::uint32_t columnsX,
                                           std::uint32_t columnsY, std::uint32_t longest);

/// The slots of `grid` that hold particles, in runs of at most LATTICE_GROUP slots (`layers` counts slots),
/// in order. Empty slots between two particles of a run belong to it; the state has zeros there.
std::vector<layout::LatticeChunk> runsOf(const Grid& grid, const Box& box);

} // namespace sinew::sim::lattice
