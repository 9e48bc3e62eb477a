#version 460
// The surface of a cut, second pass: which points there are. On an edge between two parts of some tetrahedron, one for each
// end, or one for both where another tetrahedron holds the ends together: that closes the front of a cut without a gap and
// without a search. On a face that is split in three likewise; in the middle of what is split in three or four.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "cut.glsl"
#include "link_masks.glsl"
#include "kuhn.glsl"
#include "cut_points.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer Cells { uint cells[]; };
layout(std430, binding = 2) readonly buffer Dirty { uint dirty[]; };
layout(std430, binding = 3) readonly buffer Partitions { uint partitions[]; };
layout(std430, binding = 4) writeonly buffer Owned { uvec4 owned[]; };

void markEdge(uint i, uint d, inout uvec4 own) {
    bool isNeeded = false, isJoined = false;
    [[dont_unroll]] for (uint low = 0u; low < 8u; ++low) {
        const uint cell = i - slotOf(0u, low), high = low | d;
        if ((low & d) != 0u || !isFilled(cells[cell])) continue;
        [[dont_unroll]] for (uint p = 0u; p < tetrahedra; ++p) {
            const uvec4 corners = cornersOf(p), labels = labelsOf(partitionOf(partitions[cell], p));
            const int a = bitCount(low), b = bitCount(high); // corners of a way have 0, 1, 2, 3 bits
            if (corners[a] != low || corners[b] != high) continue;
            if (labels[a] == labels[b]) isJoined = true;
            else isNeeded = true;
        }
    }
    if (!isNeeded) return;
    setBit(own, edgeBit(d, 0u));
    setBit(own, isJoined ? weldBit(d) : edgeBit(d, 1u));
}

// As one side sees a face.
uvec3 seen(Side side) {
    return restricted(labelsOf(partitionOf(partitions[side.cell], side.p)), faceOf(side.m));
}

void markFace(uint i, uint q, inout uvec4 own) {
    const Side first = firstSide(i, q), second = secondSide(i, q);
    const bool hasFirst = isFilled(cells[first.cell]), hasSecond = isFilled(cells[second.cell]);
    const uvec3 apart = uvec3(0u, 1u, 2u), a = hasFirst ? seen(first) : apart, b = hasSecond ? seen(second) : apart;
    if (!(hasFirst && a == apart) && !(hasSecond && b == apart)) return;
    const bool areFirst = min(a.y, b.y) == 0u, isLast = min(a.z, b.z) == 2u;
    setBit(own, faceBit(q, 0u));
    if (!areFirst) setBit(own, faceBit(q, 1u));
    if (isLast) setBit(own, faceBit(q, 2u));
    else if (min(a.z, b.z) == 1u && !areFirst) setBit(own, mergeBit(q));
}

// Whether any tetrahedron at a node is split.
bool isSplitAround(uint i) {
    uint all = 0u;
    [[dont_unroll]] for (uint k = 0u; k < 8u; ++k) all |= partitions[i - slotOf(0u, k)];
    return all != 0u;
}

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item;
    if (dirty[i >> 5] == 0u) return;
    uvec4 own = uvec4(0u);
    if (!isSplitAround(i)) {
        owned[i] = own;
        return;
    }
    [[dont_unroll]] for (uint d = 1u; d < 8u; ++d) {
        const ivec3 direction = cornerOf(int(d));
        if (!isAlive(links[i], direction.x, direction.y, direction.z)) markEdge(i, d, own);
    }
    [[dont_unroll]] for (uint q = 0u; q < 12u; ++q) markFace(i, q, own);
    [[dont_unroll]] for (uint p = 0u; p < tetrahedra && isFilled(cells[i]); ++p) {
        const uvec4 labels = labelsOf(partitionOf(partitions[i], p));
        [[dont_unroll]] for (uint n = 0u; n < 4u && partsOf(labels) > 2u; ++n)
            if (labels[n] == n) setBit(own, middleBit(p, n));
    }
    owned[i] = own;
}
