#version 460
// Names the island of every particle that is awake, and finds how long it rests: as long as what rests least of it.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Weights { float weights[]; }; // inverse mass of what is awake [1/kg]
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) readonly buffer Rests { vec4 rests[]; };      // w: how long [s]
layout(std430, binding = 3) coherent buffer Islands { uint islands[]; };  // in: parents (join_islands)
layout(std430, binding = 4) buffer Least { uint least[]; };               // bits of a float [s]
layout(push_constant) uniform Push { SleepPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (weights[i] == 0.0 || velocities[i].w == 0.0) return;
    uint root = i, parent = islands[i];
    while (parent != root) {
        root = parent;
        parent = islands[root];
    }
    islands[i] = root; // a shorter way to the same root for whoever comes by
    atomicMin(least[root], floatBitsToUint(rests[i].w));
}
