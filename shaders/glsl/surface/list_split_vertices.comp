#version 460
// Lists the vertices of a skin that place_split_vertices may have to move: those in cells that a cut has split, and those that
// have moved to the blade.
#extension GL_GOOGLE_include_directive : require
#include "common/cut.glsl"

layout(std430, binding = 0) readonly buffer Hung { HungVertex hung[]; };
layout(std430, binding = 1) readonly buffer Partitions { uint partitions[]; };
layout(std430, binding = 2) readonly buffer Moved { vec4 moved[]; };
layout(std430, binding = 3) buffer Counts { uint counts[]; };
layout(std430, binding = 4) writeonly buffer Listed { uint listed[]; }; // each body begins at its first vertex

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint v = push.first + item;
    if (partitions[hung[v].cell] != 0u || moved[v].w >= VERTEX_MOVED)
        listed[push.first + atomicAdd(counts[SKIN_LISTS * push.run + SKIN_SPLIT], 1u)] = v;
}
