#version 460
// Counting sort, fourth pass: computes the start of each slot's particles; counts become 0 for the next build. The
// first three starts are repeated after the last, increased by the total: a range of three slots may run over the end
// of the table.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) buffer Counts { uint counts[]; };
layout(std430, binding = 1) readonly buffer Sums { uint sums[]; };
layout(std430, binding = 2) writeonly buffer Starts { uint starts[]; };
layout(push_constant) uniform Push { GridPush push; };

void main() {
    const uint chunk = itemIndex(push.cells / GRID_CHUNK);
    const uint total = sums[push.cells / GRID_CHUNK];
    uint start = sums[chunk];
    for (uint c = 0u; c < GRID_CHUNK; ++c) {
        const uint slot = chunk * GRID_CHUNK + c;
        starts[slot] = start;
        if (slot < 3u) starts[push.cells + slot] = total + start;
        start += counts[slot];
        counts[slot] = 0u;
    }
}
