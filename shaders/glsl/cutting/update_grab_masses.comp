#version 460
// Updates the particle data of grabs after a cut: each piece is held by itself, with its own mass.
#extension GL_GOOGLE_include_directive : require
#include "common/cut.glsl"

layout(std430, binding = 0) readonly buffer Particles { uint particles[]; }; // one per slot
layout(std430, binding = 1) readonly buffer Pieces { uint pieces[]; };
layout(std430, binding = 2) readonly buffer UncutBodies { GrabBody uncutBodies[]; };
layout(std430, binding = 3) readonly buffer Weights { uint weights[]; };
layout(std430, binding = 4) writeonly buffer Bodies { GrabBody bodies[]; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint p = particles[push.first + item];
    if (p == NO_PARTICLE) return;
    const GrabBody uncut = uncutBodies[p];
    const float weight = max(float(weights[pieces[p]]), 1.0) / WHOLE_PIECE;
    bodies[p] = GrabBody(pieces[p], uncut.part / weight, uncut.mass * weight, uncut.slot);
}
