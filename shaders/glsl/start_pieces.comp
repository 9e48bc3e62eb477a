#version 460
// Connected components, before the first round: every node is a piece of its own.
#extension GL_GOOGLE_include_directive : require
#include "cut.glsl"

layout(std430, binding = 0) writeonly buffer Labels { uint labels[]; };
layout(std430, binding = 1) readonly buffer Particles { uint particles[]; };
layout(std430, binding = 2) writeonly buffer Sizes { uint sizes[]; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item;
    labels[i] = i;
    if (particles[i] != NO_PARTICLE) sizes[particles[i]] = 0u;
}
