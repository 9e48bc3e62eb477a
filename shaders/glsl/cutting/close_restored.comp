#version 460
// Ends a step in which bodies came or went: counts the links that are whole again, or brings dead ones back if the step
// is undone. Pieces are found again.
#extension GL_GOOGLE_include_directive : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"

layout(std430, binding = 0) readonly buffer Bodies { uint bodies[]; };   // by slot
layout(std430, binding = 1) readonly buffer Changes { uint changes[]; }; // by body: POOL_...
layout(std430, binding = 2) readonly buffer Whole { uint whole[]; };     // by slot: links of the uncut body
layout(std430, binding = 3) readonly buffer Replaced { ReplacedNode replaced[]; };
layout(std430, binding = 4) buffer Links { uint links[]; };
layout(std430, binding = 5) buffer Hits { LinkHits hits[]; };
layout(std430, binding = 6) readonly buffer Status { StatusWords status; };
layout(std430, binding = 7) buffer Work { CutWork work; };
layout(constant_id = 1) const bool hasSurface = false;
layout(std430, binding = 8) writeonly buffer Near { uint near[]; }; // 1 = the gradient is needed there
#include "motions/changes.glsl"

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item;
    if (!comesOrGoes(bodies[i])) return;
    if (work.isChanged == 0u) atomicMax(work.isChanged, 1u);
    const ReplacedNode node = replaced[i];
    if (!isFinished(status)) {
        links[i] = node.links;
        hits[i] = LinkHits(node.hitsLow, node.hitsHigh);
        return;
    }
    const uint restored = whole[i] & ~node.links & OWNED_MASK & push.stiffLinks;
    if (restored != 0u) atomicAdd(work.restored, uint(bitCount(restored)));
    if (hasSurface) near[i] = 0u;
}
