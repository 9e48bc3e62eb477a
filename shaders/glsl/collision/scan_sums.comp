#version 460
// Counting sort, third pass, one work group: replaces the sums of chunks by the sums of all chunks before; after them
// the total.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) buffer Sums { uint sums[]; };
layout(push_constant) uniform Push { GridPush push; };
shared uint partial[GROUP_SIZE];

void main() {
    const uint lane = isReversed ? GROUP_SIZE - 1u - gl_LocalInvocationID.x : gl_LocalInvocationID.x;
    const uint each = push.cells / (GRID_CHUNK * GROUP_SIZE), first = lane * each;
    uint sum = 0u;
    for (uint c = first; c < first + each; ++c) sum += sums[c];
    partial[lane] = sum;
    barrier();
    uint before = 0u;
    for (uint l = 0u; l < lane; ++l) before += partial[l];
    for (uint c = first; c < first + each; ++c) {
        const uint here = sums[c];
        sums[c] = before;
        before += here;
    }
    if (lane == GROUP_SIZE - 1u) sums[push.cells / GRID_CHUNK] = before;
}
