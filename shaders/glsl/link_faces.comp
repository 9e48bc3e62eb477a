#version 460
// Sorts every moving face's points by index, and says where in a point's list the face is: there its corners find what
// the contact does to them.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer FaceCandidates { uint faceCandidates[]; };
layout(std430, binding = 1) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 2) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 3) buffer FaceFound { uint faceFound[]; };
layout(std430, binding = 4) writeonly buffer Links { uint links[]; }; // elements of contacts
layout(std430, binding = 5) writeonly buffer LinkCounts { uint linkCounts[]; };
layout(std430, binding = 6) writeonly buffer Points { FacePoints points; };
layout(std430, binding = 7) buffer Status { StatusWords status; };
layout(std430, binding = 8) buffer Bounds { GridBounds bounds; };
layout(std430, binding = 9) readonly buffer Faces { ContactFace faces[]; };
#define GROUPS_BINDING 10
#define LISTS_PARTICLES
#include "listed_groups.glsl"
layout(push_constant) uniform Push { FaceFindPush push; };
#define BLOCK 16

uint elementOf(uint i, uint f) {
    uint low = 0u, high = counts[i];
    while (low < high) {
        const uint middle = (low + high) / 2u;
        if (contacts[middle * push.row + i].other < f) low = middle + 1u;
        else high = middle;
    }
    return min(low, push.capacity - 1u) * push.row + i; // not there only where the step will be undone
}

void main() {
    const uint f = itemIndex(push.moving);
    if (f == 0u) points = FacePoints(0u, 0u, 0u, 0u); // for the next time
    if (f >= push.moving) return;
    const uint all = faceFound[f], n = min(all, push.capacity);
    if (all > push.capacity) atomicMax(status.candidates, min(all, push.limit + 1u));
    for (uint first = 0u; first < n; first += BLOCK) { // a block at a time: see sort_contacts
        uint mine[BLOCK], rank[BLOCK];
        [[unroll]] for (uint b = 0u; b < BLOCK; ++b) {
            mine[b] = faceCandidates[min(first + b, n - 1u) * push.faceRow + f];
            rank[b] = 0u;
        }
        for (uint s = 0u; s < n; ++s) {
            const uint other = faceCandidates[s * push.faceRow + f];
            [[unroll]] for (uint b = 0u; b < BLOCK; ++b) rank[b] += other < mine[b] ? 1u : 0u;
        }
        [[unroll]] for (uint b = 0u; b < BLOCK; ++b)
            if (first + b < n) links[rank[b] * push.faceRow + f] = elementOf(mine[b], f);
    }
    linkCounts[f] = n;
    if (n > 0u) {
        listParticle(faces[f].a);
        listParticle(faces[f].b);
        listParticle(faces[f].c);
    }
    faceFound[f] = 0u;
}
