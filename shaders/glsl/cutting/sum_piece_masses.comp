#version 460
// Sums the mass of each piece for grabs after pieces were found again, as a part of the uncut body in integers, so
// that the order does not matter.
#extension GL_GOOGLE_include_directive : require
#include "common/cut.glsl"

layout(std430, binding = 0) readonly buffer Particles { uint particles[]; }; // one per slot
layout(std430, binding = 1) readonly buffer Pieces { uint pieces[]; };
layout(std430, binding = 2) readonly buffer UncutBodies { GrabBody uncutBodies[]; };
layout(std430, binding = 3) buffer Weights { uint weights[]; }; // at the particle that a piece is named after

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint p = particles[push.first + item];
    if (p != NO_PARTICLE) atomicAdd(weights[pieces[p]], uint(uncutBodies[p].part * WHOLE_PIECE + 0.5));
}
