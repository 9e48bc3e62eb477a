#version 460
// Connected components, before the first round: attaches every node to the lowest one that a link leads to, mostly in
// long chains along the grid, which needs no atomics.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"

layout(std430, binding = 0) writeonly buffer Labels { uint labels[]; };
layout(std430, binding = 1) readonly buffer Particles { uint particles[]; };
layout(std430, binding = 2) writeonly buffer Sizes { uint sizes[]; };
layout(std430, binding = 3) readonly buffer Links { uint links[]; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item, own = links[i];
    int lowest = 0;
    [[unroll]] for (int bit = 0; bit < FIRST_OWNED; ++bit)
        lowest = min(lowest, (own >> bit & 1u) != 0u ? offsetOf(directionOf(bit)) : 0);
    labels[i] = uint(int(i) + lowest);
    if (particles[i] != NO_PARTICLE) sizes[particles[i]] = 0u;
}
