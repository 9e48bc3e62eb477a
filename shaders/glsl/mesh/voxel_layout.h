// Structs and push constants shared by C++ and the kernels of the voxelisation (src/mesh/gpu); rules as in layout.h.
#ifndef SINEW_VOXEL_LAYOUT_H
#define SINEW_VOXEL_LAYOUT_H
#include "common/layout.h"

#ifdef __cplusplus
namespace sinew::mesh::gpu::layout {
using sim::layout::uint;
using sim::layout::vec4;
#endif

// A cell of the grid. While triangles are counted, `end` is the number in the cell, then the start of its list, at
// last the end of its list; `hull` is 1 for hull cells, then the number of hull cells before this one.
struct VoxelCell {
    uint end, hull;
};
#define VOXEL_SCAN_BLOCK 2048 // cells that one work group adds up

// Push constants of every kernel; most use only a part.
struct VoxelPush {
    uint first, count;                        // items of this dispatch
    uint cellsX, cellsY, cellsZ, fractionBits; // coordinates are integers, 2^fractionBits a cell
    uint cellCount;                           // in `Cells`: of the grid, or blocks of a higher level of the prefix sum
    uint axis;                                // axis of the lines
    uint triangle, triangleCount;             // a batch
    uint nodeCount;
};

// A box of triangles, depth first. A leaf has count > 0.
struct WindingNode {
    vec4 center; // [cells]; w = square of the distance beyond which the node counts as a dipole
    vec4 dipole; // sum of area x normal / (4 pi) [cells^2]
    uint next;   // the next node after this subtree
    uint first, count, unused;
};

#ifdef __cplusplus
} // namespace sinew::mesh::gpu::layout
#endif
#endif
