#version 460
// Connected components, last pass: names the piece of every particle after the particle in the piece's lowest slot,
// and counts pieces, but those of absent bodies, and their particles. An invocation counts a row of slots, most of which belong to one piece.
#extension GL_GOOGLE_include_directive : require
#include "common/cut.glsl"
#include "common/absent.glsl"

layout(std430, binding = 0) readonly buffer Labels { uint labels[]; };
layout(std430, binding = 1) readonly buffer Particles { uint particles[]; };
layout(std430, binding = 2) writeonly buffer Pieces { uint pieces[]; };
layout(std430, binding = 3) buffer Sizes { uint sizes[]; };
layout(std430, binding = 4) buffer Counts { CutCounts counts; };
layout(constant_id = 1) const bool mayBeAbsent = false;
layout(std430, binding = 5) readonly buffer Positions { vec4 positions[]; };

bool isThere(uint i) { return !mayBeAbsent || !isAbsent(positions[i].xyz); }

void main() {
    const uint chunks = (push.count - 1u) / PIECE_CHUNK + 1u, chunk = itemIndex(chunks);
    if (chunk >= chunks) return;
    const uint begin = chunk * PIECE_CHUNK, end = min(begin + PIECE_CHUNK, push.count);
    uint piece = NO_PARTICLE, found = 0u, lowest = 0u;
    for (uint item = begin; item < end; ++item) {
        const uint i = push.first + item, particle = particles[i];
        if (particle == NO_PARTICLE) continue;
        const uint own = particles[labels[i]];
        pieces[particle] = own;
        lowest += own == particle && isThere(i) ? 1u : 0u;
        if (own != piece && found > 0u) {
            atomicAdd(sizes[piece], found);
            found = 0u;
        }
        piece = own;
        ++found;
    }
    if (found > 0u) atomicAdd(sizes[piece], found);
    if (lowest > 0u) atomicAdd(counts.pieces, lowest);
}
