#version 460
// Removes fragments after pieces were found again: marks the particles of pieces with too few of them. An uncut body
// stays, however small.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Labels { uint labels[]; };
layout(std430, binding = 1) readonly buffer Particles { uint particles[]; };
layout(std430, binding = 2) readonly buffer Sizes { uint sizes[]; };
layout(std430, binding = 3) writeonly buffer Pieces { uint pieces[]; };
layout(std430, binding = 4) buffer Counts { CutCounts counts; };
layout(std430, binding = 5) readonly buffer Debris { DebrisParticle debris[]; }; // by particle
layout(push_constant) uniform Push { DebrisPush push; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item, particle = particles[i];
    if (particle == NO_PARTICLE) return;
    const uint piece = particles[labels[i]];
    if (sizes[piece] >= min(push.least, debris[particle].whole)) return;
    pieces[particle] = REMOVED_PIECE;
    atomicAdd(counts.debrisParticles, 1u);
    atomicAdd(counts.debrisMass, debris[particle].mass);
    if (piece != particle) return;
    atomicAdd(counts.pieces, ~0u); // minus one
    atomicAdd(counts.debris, 1u);
}
