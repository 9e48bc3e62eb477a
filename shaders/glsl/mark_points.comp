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
layout(std430, binding = 1) readonly buffer Complex { uint complex[]; };
layout(std430, binding = 2) readonly buffer ListedCounts { uint listedCounts[]; };
layout(std430, binding = 3) readonly buffer Partitions { uint partitions[]; };
layout(std430, binding = 4) writeonly buffer Owned { uvec4 owned[]; };
layout(std430, binding = 5) readonly buffer Listed { uint listed[]; };
#include "listed_slot.glsl"

#include "seen_faces.glsl"

// What prisms on the two faces of a tetrahedron at the edge from corner a to b make of it.
void seePrisms(uint cell, uint p, uint a, uint b, inout bool isNeeded, inout bool isJoined) {
    [[dont_unroll]] for (uint m = 0u; m < 4u; ++m) {
        const Face owner = ownerOf(cell, p, m);
        if (m == a || m == b || !hasPrisms(complex[owner.slot], owner.q)) continue;
        const uvec3 face = faceOf(m), seen = seenAlone(Side(cell, p, m));
        const uint first = face.x == a ? 0u : 1u, second = face.z == b ? 2u : 1u; // a < b
        if (seen[first] == seen[second]) isJoined = true;
        else isNeeded = true;
    }
}

void markEdge(uint i, uint d, inout uvec4 own) {
    const bool arePrismsNear = (complex[i] & COMPLEX_HAS_PRISMS) != 0u;
    bool isNeeded = hasThinPrisms(complex[i], d), isJoined = false;
    [[dont_unroll]] for (uint n = 0u; n < 6u; ++n) {
        const uint around = aroundOf(d, n), low = around & 7u, p = around >> 3, cell = i - slotOf(0u, low);
        const uint a = uint(bitCount(low)), b = uint(bitCount(low | d)); // corners of a way have 0, 1, 2, 3 bits
        const uvec4 labels = labelsOf(partitionOf(partitions[cell], p));
        if (hasTetrahedron(complex[cell], p)) {
            if (labels[a] == labels[b]) isJoined = true;
            else isNeeded = true;
        }
        if (arePrismsNear) seePrisms(cell, p, a, b, isNeeded, isJoined);
    }
    if (!isNeeded) return;
    setBit(own, edgeBit(d, 0u));
    setBit(own, isJoined ? weldBit(d) : edgeBit(d, 1u));
}

void markFace(uint i, uint q, inout uvec4 own) {
    const Side first = firstSide(i, q), second = secondSide(i, q);
    const bool hasFirst = hasTetrahedron(complex[first.cell], first.p), hasSecond = hasTetrahedron(complex[second.cell], second.p);
    const bool isStoodOn = hasPrisms(complex[i], q);
    const uvec3 apart = uvec3(0u, 1u, 2u);
    const uvec3 all[3] = uvec3[3](hasFirst ? seenFrom(first) : apart, hasSecond ? seenFrom(second) : apart, isStoodOn ? seenAlone(first) : apart);
    if (!(hasFirst && all[0] == apart || hasSecond && all[1] == apart || isStoodOn && all[2] == apart)) return;
    bool isSecondFirst = false, isThirdFirst = false, isThirdSecond = false;
    [[dont_unroll]] for (uint n = 0u; n < 3u; ++n) {
        isSecondFirst = isSecondFirst || all[n].y == 0u;
        isThirdFirst = isThirdFirst || all[n].z == 0u;
        isThirdSecond = isThirdSecond || all[n].z == 1u;
    }
    const bool areAll = isThirdSecond && (isSecondFirst || isThirdFirst);
    setBit(own, faceBit(q, 0u));
    if (!isSecondFirst && !areAll) setBit(own, faceBit(q, 1u));
    if (!isThirdFirst && !isThirdSecond) setBit(own, faceBit(q, 2u));
    else if (isThirdSecond && !areAll) setBit(own, mergeBit(q));
}

// Whether any tetrahedron at a node is split, or a prism may be.
bool isSplitAround(uint i) {
    uint all = complex[i] & COMPLEX_HAS_PRISMS;
    [[dont_unroll]] for (uint k = 0u; k < 8u; ++k) all |= partitions[i - slotOf(0u, k)];
    return all != 0u;
}

void main() {
    const uint i = listedSlot();
    if (i == NO_SLOT) return;
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
    [[dont_unroll]] for (uint p = 0u; p < tetrahedra; ++p) {
        if (!hasTetrahedron(complex[i], p)) continue;
        const uvec4 labels = labelsOf(partitionOf(partitions[i], p));
        [[dont_unroll]] for (uint n = 0u; n < 4u && partsOf(labels) > 2u; ++n)
            if (labels[n] == n) setBit(own, middleBit(p, n));
    }
    owned[i] = own;
}
