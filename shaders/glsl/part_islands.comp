#version 460
// After pieces were found anew: what is linked, for those that sleep. A piece is named by its lowest slot, which may be one
// that never moves.
#extension GL_GOOGLE_include_directive : require
#include "cut.glsl"

layout(std430, binding = 0) readonly buffer Labels { uint labels[]; };
layout(std430, binding = 1) readonly buffer Particles { uint particles[]; };
layout(std430, binding = 2) writeonly buffer Components { uint components[]; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item;
    if (particles[i] != NO_PARTICLE) components[i] = labels[i];
}
