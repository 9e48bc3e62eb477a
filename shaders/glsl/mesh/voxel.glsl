// Shared by the kernels of the voxelisation. Coordinates are integers, 2^fractionBits a cell, so that no test of a
// triangle against a cell or a line is ever rounded. The kernels define the buffers.
#include "common/kernel.glsl"
#include "mesh/voxel_layout.h"
#include "mesh/wide.glsl"

layout(push_constant) uniform Push { VoxelPush push; };

ivec3 gridSize() {
    return ivec3(push.cellsX, push.cellsY, push.cellsZ);
}

// Size of a cell [units].
int cellSize() {
    return 1 << push.fractionBits;
}

// Distance in memory between neighbouring cells along x, y, z.
uvec3 cellStrides() {
    return uvec3(1u, push.cellsX, push.cellsX * push.cellsY);
}

uvec3 cellAt(uint index) {
    return uvec3(index % push.cellsX, index / push.cellsX % push.cellsY, index / (push.cellsX * push.cellsY));
}

// Components in axis order: the other two in the order x, y, z, then the one along `axis`.
ivec3 seenAlong(uint axis, ivec3 p) {
    return axis == 0u ? p.yzx : axis == 1u ? p.xzy : p;
}

uvec3 seenAlong(uint axis, uvec3 p) {
    return axis == 0u ? p.yzx : axis == 1u ? p.xzy : p;
}

// Index of the first line along an axis; lines are stored axis by axis.
uint firstColumn(uint axis) {
    return axis == 0u ? 0u
           : axis == 1u ? push.cellsY * push.cellsZ
                        : push.cellsY * push.cellsZ + push.cellsX * push.cellsZ;
}
