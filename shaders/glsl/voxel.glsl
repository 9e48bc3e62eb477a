// What the kernels of the voxelisation share. Coordinates are whole numbers, 2^fractionBits a cell, so that no test of a
// triangle against a cell or a line is ever rounded. Buffers are named by the kernels that bind them.
#include "kernel.glsl"
#include "voxel_layout.h"
#include "wide.glsl"

layout(push_constant) uniform Push { VoxelPush push; };

ivec3 gridSize() {
    return ivec3(push.cellsX, push.cellsY, push.cellsZ);
}

// [units] of a cell
int cellSize() {
    return 1 << push.fractionBits;
}

// How far apart two cells are in memory that are neighbours along x, y, z.
uvec3 cellStrides() {
    return uvec3(1u, push.cellsX, push.cellsX * push.cellsY);
}

uvec3 cellAt(uint index) {
    return uvec3(index % push.cellsX, index / push.cellsX % push.cellsY, index / (push.cellsX * push.cellsY));
}

// Seen along `axis`: the other two in the order x, y, z, then the axis itself.
ivec3 seenAlong(uint axis, ivec3 p) {
    return axis == 0u ? p.yzx : axis == 1u ? p.xzy : p;
}

uvec3 seenAlong(uint axis, uvec3 p) {
    return axis == 0u ? p.yzx : axis == 1u ? p.xzy : p;
}

// Lines along an axis stand behind those along the axes before it.
uint firstColumn(uint axis) {
    return axis == 0u ? 0u
           : axis == 1u ? push.cellsY * push.cellsZ
                        : push.cellsY * push.cellsZ + push.cellsX * push.cellsZ;
}
