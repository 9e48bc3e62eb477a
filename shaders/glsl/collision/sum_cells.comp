#version 460
// Counting sort, second pass: number of particles in each chunk of the table.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 1) writeonly buffer Sums { uint sums[]; };
layout(push_constant) uniform Push { GridPush push; };

void main() {
    const uint chunk = itemIndex(push.cells / GRID_CHUNK); // whole work groups
    uint sum = 0u;
    for (uint c = 0u; c < GRID_CHUNK; ++c) sum += counts[chunk * GRID_CHUNK + c];
    sums[chunk] = sum;
}
