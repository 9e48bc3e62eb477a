#version 460
// Sets the size of removed pieces to 0. Runs after remove_debris, which reads the sizes.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Particles { uint particles[]; };
layout(std430, binding = 1) readonly buffer Pieces { uint pieces[]; };
layout(std430, binding = 2) writeonly buffer Sizes { uint sizes[]; };
layout(push_constant) uniform Push { DebrisPush push; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint particle = particles[push.first + item];
    if (particle != NO_PARTICLE && pieces[particle] == REMOVED_PIECE) sizes[particle] = 0u;
}
