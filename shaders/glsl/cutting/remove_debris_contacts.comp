#version 460
// Removes the particles of fragments from a grid of contacts, and requests a rebuild of its lists in the next step.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Particles { uint particles[]; };
layout(std430, binding = 1) readonly buffer Pieces { uint pieces[]; };
layout(std430, binding = 2) buffer Radii { float radii[]; }; // below 0 = touches nothing
layout(std430, binding = 3) buffer Bounds { GridBounds bounds; };
layout(push_constant) uniform Push { DebrisPush push; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item, particle = particles[i];
    if (particle == NO_PARTICLE || pieces[particle] != REMOVED_PIECE || radii[i] < 0.0) return;
    radii[i] = -1.0;
    atomicMax(bounds.moved, 1u);
}
