#version 460
// Forces fragments to rest: they fall asleep in the next step and cost nothing.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Particles { uint particles[]; }; // one per slot
layout(std430, binding = 1) readonly buffer Pieces { uint pieces[]; };
layout(std430, binding = 2) buffer Limits { float limits[]; }; // below 0 = rests
layout(push_constant) uniform Push { DebrisPush push; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item, particle = particles[i];
    if (particle != NO_PARTICLE && pieces[particle] == REMOVED_PIECE) limits[i] = -1.0;
}
