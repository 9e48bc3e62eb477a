#version 460
// Lists the hull cells in order.
#extension GL_GOOGLE_include_directive : require
#include "mesh/voxel.glsl"

layout(std430, binding = 0) readonly buffer Cells { VoxelCell cells[]; };
layout(std430, binding = 1) writeonly buffer HullCells { uint hullCells[]; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const uint cell = push.first + i;
    if ((cell == 0u ? 0u : cells[cell - 1u].end) != cells[cell].end) hullCells[cells[cell].hull] = cell;
}
