#version 460
// Makes bodies that come or go whole at the start of the step: their links with the marks on these, what a stroke
// remembers, and what passes before the end of the step read of their pieces. Nodes with dead links are marked as beside
// a cut, so that all that follows from links is found anew there. For an undone step links are kept (close_restored), and
// pieces are found again.
#extension GL_GOOGLE_include_directive : require
#include "common/cut.glsl"

layout(std430, binding = 0) readonly buffer Bodies { uint bodies[]; };   // by slot
layout(std430, binding = 1) readonly buffer Changes { uint changes[]; }; // by body: POOL_...
layout(std430, binding = 2) readonly buffer Whole { uint whole[]; };     // by slot: links of the uncut body
layout(std430, binding = 3) buffer Links { uint links[]; };
layout(std430, binding = 4) buffer Hits { LinkHits hits[]; };
layout(std430, binding = 5) writeonly buffer PlacesBefore { vec4 before[]; }; // w = 0: no blade yet
layout(std430, binding = 6) writeonly buffer Replaced { ReplacedNode replaced[]; };
layout(std430, binding = 7) buffer Dirty { uint dirty[]; };
layout(constant_id = 1) const bool hasPulls = false;
layout(std430, binding = 8) writeonly buffer Pulls { vec4 pulls[]; }; // w = 0: not yet set
layout(std430, binding = 9) readonly buffer Particles { uint particles[]; }; // one per slot
layout(std430, binding = 10) readonly buffer WholePieces { uint wholePieces[]; };
layout(std430, binding = 11) writeonly buffer Pieces { uint pieces[]; }; // by particle
layout(constant_id = 2) const bool maySleep = false;
layout(std430, binding = 12) readonly buffer WholeComponents { uint wholeComponents[]; };
layout(std430, binding = 13) writeonly buffer Components { uint components[]; }; // of what sleeps as one, by slot
layout(constant_id = 3) const bool hasLimits = false; // fragments that were removed rest: put_debris_to_sleep
layout(std430, binding = 14) readonly buffer InitialLimits { float initialLimits[]; };
layout(std430, binding = 15) writeonly buffer Limits { float limits[]; };
#define MARKS_DIRTY
#include "lattice/dirty.glsl"
#include "motions/changes.glsl"

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item;
    if (!comesOrGoes(bodies[i])) return;
    replaced[i] = ReplacedNode(links[i], hits[i].low, hits[i].high);
    hits[i] = LinkHits(0u, 0u);
    before[i] = vec4(0.0);
    if (hasPulls) pulls[i] = vec4(0.0);
    if (particles[i] != NO_PARTICLE) {
        pieces[particles[i]] = wholePieces[particles[i]];
        if (maySleep) components[i] = wholeComponents[i];
        if (hasLimits) limits[i] = initialLimits[i];
    }
    if (links[i] == whole[i]) return;
    links[i] = whole[i];
    markAround(i);
}
