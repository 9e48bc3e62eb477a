// Structs and push constants that C++ and the kernels of the voxelisation (src/mesh/gpu) share; rules as in layout.h.
#ifndef SINEW_VOXEL_LAYOUT_H
#define SINEW_VOXEL_LAYOUT_H
#include "layout.h"

#ifdef __cplusplus
namespace sinew::mesh::gpu::layout {
using sim::layout::uint;
using sim::layout::vec4;
#endif

// A cell of the grid. While triangles are counted and listed, `end` counts those of a cell, then it is where
// its list starts, and at last where that ends; `hull` says whether it has any, then how many cells before it have.
struct VoxelCell {
    uint end, hull;
};
#define VOXEL_SCAN_BLOCK 2048 // cells that one work group sums up

// What every kernel gets; most use a part.
struct VoxelPush {
    uint first, count;                        // items of this dispatch
    uint cellsX, cellsY, cellsZ, fractionBits; // coordinates are whole numbers, 2^fractionBits a cell
    uint cellCount;                           // in `Cells`: of the grid, or blocks of a higher level of the prefix sum
    uint axis;                                // of the lines
    uint triangle, triangleCount;             // a batch
    uint nodeCount;
};

// A box of triangles, depth first. A leaf has count > 0.
struct WindingNode {
    vec4 center; // [cells]; w = square of the distance from where on the node counts as a dipole
    vec4 dipole; // sum of area x normal / (4 pi) [cells^2]
    uint next;   // the node after all that this one holds
    uint first, count, unused;
};

#ifdef __cplusplus
} // namespace sinew::mesh::gpu::layout
#endif
#endif
