#version 460
// Sorts every particle's candidates by index, so that sums over them do not depend on when and how they were found, and
// adds at which distance they touch. LISTS_OWNERS: lists the groups of which one has a candidate. EDGES: and those of ends. Ranks a block of a list at a time against the whole: registers instead of shifting.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "kernel.glsl"

#ifdef TEXELS
layout(binding = 0) uniform usamplerBuffer candidates;
layout(binding = 1) uniform samplerBuffer radii;
#define CANDIDATE(i) texelFetch(candidates, int(i)).x
#define RADIUS(i) texelFetch(radii, int(i)).x
#else
layout(std430, binding = 0) readonly buffer Candidates { uint candidates[]; };
layout(std430, binding = 1) readonly buffer Radii { float radii[]; };
#define CANDIDATE(i) candidates[i]
#define RADIUS(i) radii[i]
#endif
layout(std430, binding = 2) buffer Found { uint found[]; };
layout(std430, binding = 3) writeonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 4) writeonly buffer Counts { uint counts[]; };
layout(std430, binding = 5) buffer Status { StatusWords status; };
#ifdef LISTS_OWNERS
layout(std430, binding = 6) buffer Bounds { GridBounds bounds; };
#define GROUPS_BINDING 7
#include "listed_groups.glsl"
#endif
#ifdef EDGES
layout(std430, binding = PARTICLES_BINDING + 2) readonly buffer Edges { ContactEdge edges[]; };
layout(std430, binding = PARTICLES_BINDING + 3) writeonly buffer Sums { float sums[]; };
layout(std430, binding = PARTICLES_BINDING + 4) writeonly buffer Impulses { vec4 impulses[]; };
#endif
layout(push_constant) uniform Push { FindPush push; };
#define BLOCK 16

void main() {
    const uint i = itemIndex(push.count);
    const uint all = found[i], n = min(all, push.capacity);
    const float radius = RADIUS(i);
    if (all > push.capacity) atomicMax(status.candidates, min(all, push.limit + 1u)); // how far counting goes on depends on the order
    for (uint first = 0u; first < n; first += BLOCK) {
        uint mine[BLOCK], rank[BLOCK];
        [[unroll]] for (uint b = 0u; b < BLOCK; ++b) {
            mine[b] = CANDIDATE(min(first + b, n - 1u) * push.row + i);
            rank[b] = 0u;
        }
        for (uint s = 0u; s < n; ++s) {
            const uint other = CANDIDATE(s * push.row + i);
            [[unroll]] for (uint b = 0u; b < BLOCK; ++b) rank[b] += other < mine[b] || other == mine[b] && s < first + b ? 1u : 0u;
        }
        [[unroll]] for (uint b = 0u; b < BLOCK; ++b)
            if (first + b < n)
                contacts[rank[b] * push.row + i] = ContactCandidate(mine[b], radius + RADIUS(mine[b]));
    }
    counts[i] = n;
#ifdef LISTS_OWNERS
    if (n > 0u) listOwner(i);
#endif
#ifdef EDGES
    if (n > 0u) {
        listParticle(edges[i].a);
        listParticle(edges[i].b);
    } else { // no pass will look at it, but its ends sum it up
        sums[2u * i] = sums[2u * i + 1u] = 0.0;
        impulses[2u * i] = impulses[2u * i + 1u] = vec4(0.0);
    }
#endif
    found[i] = 0u; // large particles count on it
}
