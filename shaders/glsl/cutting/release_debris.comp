#version 460
// Releases fragments from grabs: a removed particle loses its share and its mass in every grab.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Particles { uint particles[]; }; // one per slot
layout(std430, binding = 1) readonly buffer Pieces { uint pieces[]; };
layout(std430, binding = 2) buffer Bodies { GrabBody bodies[]; };
layout(push_constant) uniform Push { DebrisPush push; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint particle = particles[push.first + item];
    if (particle != NO_PARTICLE && pieces[particle] == REMOVED_PIECE) bodies[particle].part = bodies[particle].mass = 0.0;
}
