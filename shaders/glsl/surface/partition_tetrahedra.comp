#version 460
// The surface of a cut, first pass: finds the connectivity of the corners of every tetrahedron near the last blade.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"
#include "lattice/kuhn.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer Complex { uint complex[]; };
layout(std430, binding = 2) readonly buffer ListedCounts { uint listedCounts[]; };
layout(std430, binding = 3) writeonly buffer Partitions { uint partitions[]; }; // partition of the cell above a slot, 5 bits each
layout(std430, binding = 4) writeonly buffer Near { uint near[]; };             // 1 = the gradient is needed there
layout(std430, binding = 5) readonly buffer Listed { uint listed[]; };
#include "common/listed_slot.glsl"

bool isLinked(uint words[8], uint low, uint high) {
    const ivec3 d = cornerOf(int(low ^ high));
    return isAlive(words[low], d.x, d.y, d.z);
}

uint partitionOf(uint words[8], uvec4 corners) {
    uvec4 labels = uvec4(0u, 1u, 2u, 3u);
    [[dont_unroll]] for (int round = 0; round < 3; ++round) // a path between two corners has at most three links
        [[dont_unroll]] for (int a = 0; a < 3; ++a)
            [[dont_unroll]] for (int b = a + 1; b < 4; ++b)
                if (isLinked(words, corners[a], corners[b])) labels[a] = labels[b] = min(labels[a], labels[b]);
    return labels.y | labels.z << 1 | labels.w << 3;
}

// True if all edges of a cell's tetrahedra are alive: those owned by a corner lead along the axes on which it is low.
bool isWhole(uint words[8]) {
    uint dead = 0u;
    [[unroll]] for (uint low = 0u; low < 7u; ++low) {
        uint edges = 0u; // folded to a constant
        [[unroll]] for (uint d = 1u; d < 8u; ++d) {
            const ivec3 direction = cornerOf(int(d));
            if ((low & d) == 0u) edges |= 1u << bitOf(direction.x, direction.y, direction.z);
        }
        dead |= edges & ~words[low];
    }
    return dead == 0u;
}

// True if all links with stiffness between the cell's corners are alive.
bool isHeld(uint words[8]) {
    bool isHeld = true;
    [[dont_unroll]] for (int low = 0; low < 7; ++low)
        [[dont_unroll]] for (int high = low + 1; high < 8; ++high) {
            const ivec3 d = cornerOf(high) - cornerOf(low);
            isHeld = isHeld && (isAlive(words[low], d.x, d.y, d.z) || !isAlive(push.stiffLinks, d.x, d.y, d.z));
        }
    return isHeld;
}

void main() {
    const uint i = listedSlot();
    if (i == NO_SLOT || !isCell(complex[i])) return;
    uint words[8];
    [[unroll]] for (uint k = 0u; k < 8u; ++k) words[k] = links[slotOf(i, k)];
    uint all = 0u;
    const uint first = isWhole(words) ? tetrahedra : 0u;
    [[dont_unroll]] for (uint p = first; p < tetrahedra; ++p) all |= partitionOf(words, cornersOf(p)) << partitionBits * p;
    partitions[i] = all;
    if (all == 0u && isHeld(words)) return;
    [[dont_unroll]] for (uint k = 0u; k < 8u; ++k) near[slotOf(i, k)] = 1u;
}
