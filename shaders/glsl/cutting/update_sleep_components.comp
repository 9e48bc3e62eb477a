#version 460
// Updates the components that sleep as one after pieces were found again. A component is named by the lowest slot of
// its piece, which may hold a static particle.
#extension GL_GOOGLE_include_directive : require
#include "common/cut.glsl"

layout(std430, binding = 0) readonly buffer Labels { uint labels[]; };
layout(std430, binding = 1) readonly buffer Particles { uint particles[]; };
layout(std430, binding = 2) writeonly buffer Components { uint components[]; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item;
    if (particles[i] != NO_PARTICLE) components[i] = labels[i];
}
