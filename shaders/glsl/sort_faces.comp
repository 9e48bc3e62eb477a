#version 460
// Sorts every point's faces by index, so that sums over them do not depend on when and how they were found, and adds at
// which distance they touch.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Candidates { uint candidates[]; };
layout(std430, binding = 1) readonly buffer Radii { float radii[]; };
layout(std430, binding = 2) readonly buffer Faces { ContactFace faces[]; };
layout(std430, binding = 3) buffer Found { uint found[]; };
layout(std430, binding = 4) writeonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 5) writeonly buffer Counts { uint counts[]; };
layout(std430, binding = 6) buffer Status { StatusWords status; };
layout(std430, binding = 7) buffer Bounds { GridBounds bounds; };
#define GROUPS_BINDING 8
#define LISTS_PARTICLES
#include "listed_groups.glsl"
layout(push_constant) uniform Push { FaceFindPush push; };
#define BLOCK 16

void main() {
    const uint i = itemIndex(push.points);
    const uint all = found[i], n = min(all, push.capacity);
    if (all > push.capacity) atomicMax(status.candidates, min(all, push.limit + 1u)); // how far counting goes depends on the order
    for (uint first = 0u; first < n; first += BLOCK) {
        uint mine[BLOCK], rank[BLOCK];
        [[unroll]] for (uint b = 0u; b < BLOCK; ++b) {
            mine[b] = candidates[min(first + b, n - 1u) * push.row + i];
            rank[b] = 0u;
        }
        for (uint s = 0u; s < n; ++s) {
            const uint other = candidates[s * push.row + i];
            [[unroll]] for (uint b = 0u; b < BLOCK; ++b) rank[b] += other < mine[b] || other == mine[b] && s < first + b ? 1u : 0u;
        }
        [[unroll]] for (uint b = 0u; b < BLOCK; ++b)
            if (first + b < n)
                contacts[rank[b] * push.row + i] = ContactCandidate(mine[b], radii[i] + faces[mine[b]].thickness);
    }
    counts[i] = n;
    if (n > 0u) listParticle(i);
    found[i] = 0u;
}
