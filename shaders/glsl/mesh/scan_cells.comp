#version 460
// Exclusive prefix sum within blocks of VOXEL_SCAN_BLOCK cells, and the sum of each block: the next level scans the
// block sums.
#extension GL_GOOGLE_include_directive : require
#include "mesh/voxel.glsl"

layout(std430, binding = 0) buffer Cells { VoxelCell cells[]; };
layout(std430, binding = 1) writeonly buffer Blocks { VoxelCell blocks[]; };

const uint share = VOXEL_SCAN_BLOCK / GROUP_SIZE; // cells of an invocation
shared uvec2 sums[GROUP_SIZE];

uvec2 load(uint cell) {
    return cell < push.cellCount ? uvec2(cells[cell].end, cells[cell].hull) : uvec2(0u);
}

// Saturates at 2^32 - 1: the host rejects such a total.
uvec2 plus(uvec2 a, uvec2 b) {
    const uvec2 sum = a + b;
    return uvec2(sum.x < a.x ? 0xffffffffu : sum.x, sum.y);
}

void main() { // whole groups: no invocation leaves early
    const uint item = push.first + itemIndex(push.count), lane = item % GROUP_SIZE, first = item * share;
    uvec2 sum = uvec2(0u);
    for (uint i = 0u; i < share; ++i) sum = plus(sum, load(first + i));
    sums[lane] = sum;
    for (uint distance = 1u; distance < GROUP_SIZE; distance *= 2u) {
        barrier();
        const uvec2 before = lane >= distance ? sums[lane - distance] : uvec2(0u);
        barrier();
        sums[lane] = plus(sums[lane], before);
    }
    uvec2 start = sums[lane] - sum;
    if (lane == GROUP_SIZE - 1u) blocks[item / GROUP_SIZE] = VoxelCell(sums[lane].x, sums[lane].y);
    for (uint i = 0u; i < share; ++i) {
        const uvec2 own = load(first + i);
        if (first + i < push.cellCount) cells[first + i] = VoxelCell(start.x, start.y);
        start += own;
    }
}
