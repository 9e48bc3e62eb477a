// The triangles inside of what was cut, as seen from a cell: between the parts of its tetrahedra, each twice,
// once a side, and on faces that their two tetrahedra see split in different ways. Whoever includes this says what becomes of
//
//   triangle(a, b, c)   points as (slot, bit), right-handed seen from outside of the part that it belongs to

#include "seen_faces.glsl"

void oriented(bool isKept, uvec2 a, uvec2 b, uvec2 c) {
    triangle(a, isKept ? b : c, isKept ? c : b);
}

// One corner and three.
void partOne(uint cell, uint p, uint lone) {
    const uvec4 corners = cornersOf(p);
    const uvec3 others = faceOf(lone);
    uvec2 own[3], far[3];
    [[dont_unroll]] for (int n = 0; n < 3; ++n) {
        own[n] = edgePoint(cell, corners, lone, others[n]);
        far[n] = edgePoint(cell, corners, others[n], lone);
    }
    const bool isKept = isOutward(p, lone);
    oriented(isKept, own[0], own[1], own[2]);
    oriented(!isKept, far[0], far[1], far[2]);
}

// Two and two: the first corner with `mate`.
void partTwo(uint cell, uint p, uint mate) {
    const uvec4 corners = cornersOf(p);
    const uint x = mate == 1u ? 2u : 1u, y = mate == 3u ? 2u : 3u;
    const bool isKept = isEven[p] != (mate != 2u);
    [[dont_unroll]] for (int side = 0; side < 2; ++side) {
        const uvec4 from = uvec4(0u, mate, mate, 0u), to = uvec4(x, x, y, y);
        uvec2 quad[4];
        [[dont_unroll]] for (int n = 0; n < 4; ++n)
            quad[n] = side == 0 ? edgePoint(cell, corners, from[n], to[n]) : edgePoint(cell, corners, to[n], from[n]);
        oriented(isKept == (side == 0), quad[0], quad[1], quad[2]);
        oriented(isKept == (side == 0), quad[0], quad[2], quad[3]);
    }
}

// A face of what is split in three or four, with the middle.
void partFace(uint cell, uint p, uint m, uvec4 labels) {
    const uvec4 corners = cornersOf(p);
    const uvec3 face = faceOf(m), pattern = restricted(labels, face);
    const uint ways = waysOf(pattern);
    const bool isKept = isOutward(p, m);
    const Face owner = ownerOf(cell, p, m);
    const uint lone = loneOf(pattern);
    [[dont_unroll]] for (uint n = 0u; n < (ways == 3u ? 3u : ways == 2u ? 1u : 0u); ++n) {
        const uint a = ways == 2u ? lone : n, b = (a + 1u) % 3u, c = (a + 2u) % 3u; // places in the face
        const uvec2 ownB = edgePoint(cell, corners, face[a], face[b]), farB = edgePoint(cell, corners, face[b], face[a]);
        const uvec2 ownC = ways == 2u ? edgePoint(cell, corners, face[a], face[c]) : uvec2(owner.slot, faceBit(owner.q, a));
        const uvec2 farC = ways == 2u ? edgePoint(cell, corners, face[c], face[a]) : uvec2(owner.slot, faceBit(owner.q, b));
        oriented(!isKept, ownB, ownC, uvec2(cell, middleBit(p, labels[face[a]])));
        oriented(isKept, farB, farC, uvec2(cell, middleBit(p, labels[face[b]])));
    }
}

void partTetrahedron(uint cell, uint p, uint parted) {
    const uvec4 labels = labelsOf(parted);
    const uint parts = partsOf(labels);
    if (parts == 1u) return;
    if (parts > 2u) {
        [[dont_unroll]] for (uint m = 0u; m < 4u; ++m) partFace(cell, p, m, labels);
        return;
    }
    const uint others = uint(labels.y != 0u) + uint(labels.z != 0u) + uint(labels.w != 0u); // not with the first corner
    if (others == 2u) partTwo(cell, p, labels.y == 0u ? 1u : labels.z == 0u ? 2u : 3u);
    else partOne(cell, p, others == 3u ? 0u : labels.y != 0u ? 1u : labels.z != 0u ? 2u : 3u);
}

// Between two tetrahedra, or one and prisms, that split their face differently, one of them in two.
void fillFace(uint slot, uint q) {
    Side two = firstSide(slot, q), other = secondSide(slot, q);
    const bool hasTwo = hasTetrahedron(complex[two.cell], two.p), hasOther = hasTetrahedron(complex[other.cell], other.p);
    if (!hasTwo && !hasOther || !(hasTwo && hasOther) && !hasPrisms(complex[slot], q)) return;
    uvec3 pattern = hasTwo ? seenFrom(two) : seenAlone(two), beyond = hasOther ? seenFrom(other) : seenAlone(other);
    if (pattern == beyond || min(waysOf(pattern), waysOf(beyond)) != 2u) return;
    if (waysOf(pattern) != 2u) {
        const Side swapped = two;
        two = other;
        other = swapped;
        const uvec3 kept = pattern;
        pattern = beyond;
        beyond = kept;
    }
    const uvec4 corners = cornersOf(two.p);
    const uvec3 face = faceOf(two.m);
    const uint a = loneOf(pattern), b = (a + 1u) % 3u, c = (a + 2u) % 3u;
    const bool isThree = waysOf(beyond) == 3u, isKept = isOutward(two.p, two.m);
    const uvec2 across = edgePoint(two.cell, corners, face[b], face[c]);
    const uvec2 own = isThree ? uvec2(slot, faceBit(q, a)) : across, far = isThree ? uvec2(slot, faceBit(q, b)) : across;
    oriented(isKept, edgePoint(two.cell, corners, face[a], face[b]), edgePoint(two.cell, corners, face[a], face[c]), own);
    oriented(isKept, edgePoint(two.cell, corners, face[b], face[a]), far, edgePoint(two.cell, corners, face[c], face[a]));
}

void addInside(uint cell) {
    [[dont_unroll]] for (uint p = 0u; p < tetrahedra; ++p)
        if (hasTetrahedron(complex[cell], p)) partTetrahedron(cell, p, partitionOf(partitions[cell], p));
    [[dont_unroll]] for (uint q = 0u; q < 12u; ++q) fillFace(cell, q);
}
