#version 460
// Finds the island of every awake particle, and the resting time of the island: that of its particle that has rested
// least.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Weights { float weights[]; }; // inverse mass of awake particles [1/kg]
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) readonly buffer Rests { vec4 rests[]; };      // w: resting time [s]
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
    islands[i] = root; // shortens the path to the root for later invocations
    atomicMin(least[root], floatBitsToUint(rests[i].w));
}
