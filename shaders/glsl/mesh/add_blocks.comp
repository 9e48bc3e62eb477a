#version 460
// Second half of a prefix sum: adds to every cell the total of the blocks before its own.
#extension GL_GOOGLE_include_directive : require
#include "mesh/voxel.glsl"

layout(std430, binding = 0) buffer Cells { VoxelCell cells[]; };
layout(std430, binding = 1) readonly buffer Blocks { VoxelCell blocks[]; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const uint cell = push.first + i, block = cell / VOXEL_SCAN_BLOCK;
    cells[cell].end += blocks[block].end;
    cells[cell].hull += blocks[block].hull;
}
