// The inner triangles of a cut in one cell: between the parts of its tetrahedra, each twice, once a side, and on
// faces that their two tetrahedra split in different ways. The including kernel defines
//
//   triangle(a, b, c)   points as (slot, bit), right-handed seen from outside of the part that it belongs to
//   writeNoted()        writes the triangles since the last call, 6 at most

#include "surface/seen_faces.glsl"

void oriented(bool isKept, uvec2 a, uvec2 b, uvec2 c) {
    triangle(a, isKept ? b : c, isKept ? c : b);
}

// Splits a tetrahedron into one corner and three.
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

// Splits a tetrahedron into two and two: the first corner with `mate`.
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

// Splits one face of a tetrahedron with three or four parts, using the point at its centre.
void partFace(uint cell, uint p, uint m, uvec4 labels) {
    const uvec4 corners = cornersOf(p);
    const uvec3 face = faceOf(m), pattern = restricted(labels, face);
    const uint ways = waysOf(pattern);
    const bool isKept = isOutward(p, m);
    const Face owner = ownerOf(cell, p, m);
    const uint lone = loneOf(pattern);
    [[dont_unroll]] for (uint n = 0u; n < (ways == 3u ? 3u : ways == 2u ? 1u : 0u); ++n) {
        const uint a = ways == 2u ? lone : n, b = (a + 1u) % 3u, c = (a + 2u) % 3u; // indices in the face
        const uvec2 ownB = edgePoint(cell, corners, face[a], face[b]), farB = edgePoint(cell, corners, face[b], face[a]);
        const uvec2 ownC = ways == 2u ? edgePoint(cell, corners, face[a], face[c]) : uvec2(owner.slot, faceBit(owner.q, a));
        const uvec2 farC = ways == 2u ? edgePoint(cell, corners, face[c], face[a]) : uvec2(owner.slot, faceBit(owner.q, b));
        oriented(!isKept, ownB, ownC, uvec2(cell, middleBit(p, labels[face[a]])));
        oriented(isKept, farB, farC, uvec2(cell, middleBit(p, labels[face[b]])));
    }
}

// Two parts are done at the first face, three or four parts face by face.
void partTetrahedron(uint cell, uint p, uint m, uint parted) {
    const uvec4 labels = labelsOf(parted);
    const uint parts = partsOf(labels);
    if (parts > 2u) partFace(cell, p, m, labels);
    if (parts != 2u || m > 0u) return;
    const uint others = uint(labels.y != 0u) + uint(labels.z != 0u) + uint(labels.w != 0u); // corners apart from the first
    if (others == 2u) partTwo(cell, p, labels.y == 0u ? 1u : labels.z == 0u ? 2u : 3u);
    else partOne(cell, p, others == 3u ? 0u : labels.y != 0u ? 1u : labels.z != 0u ? 2u : 3u);
}

// The split of a face that a slot owns, seen from its two sides. If one side splits it in two and the other
// differently, that side is first.
struct Seen {
    Side from;
    uvec3 pattern, beyond;
    bool isUnlike;
};

Seen seenBoth(uint slot, uint q) {
    const Side low = firstSide(slot, q), high = secondSide(slot, q);
    const bool hasLow = hasTetrahedron(complex[low.cell], low.p), hasHigh = hasTetrahedron(complex[high.cell], high.p);
    const bool areThere = hasLow && hasHigh || (hasLow || hasHigh) && hasPrisms(complex[slot], q);
    const uvec3 ofLow = hasLow ? seenFrom(low) : seenAlone(low), ofHigh = hasHigh ? seenFrom(high) : seenAlone(high);
    const uint ways = waysOf(ofLow), waysBeyond = waysOf(ofHigh);
    const bool isUnlike = areThere && ofLow != ofHigh && min(ways, waysBeyond) == 2u;
    if (ways == 2u) return Seen(low, ofLow, ofHigh, isUnlike);
    return Seen(high, ofHigh, ofLow, isUnlike);
}

// Fills the face between two tetrahedra, or between a tetrahedron and prisms, that split it differently, one of them
// in two.
void fillFace(uint slot, uint q) {
    const Seen seen = seenBoth(slot, q);
    const Side two = seen.from;
    const uvec4 corners = cornersOf(two.p);
    const uvec3 face = faceOf(two.m);
    const uint a = loneOf(seen.pattern), b = (a + 1u) % 3u, c = (a + 2u) % 3u;
    const bool isThree = waysOf(seen.beyond) == 3u, isKept = isOutward(two.p, two.m);
    const uvec2 across = edgePoint(two.cell, corners, face[b], face[c]);
    const uvec2 own = isThree ? uvec2(slot, faceBit(q, a)) : across, far = isThree ? uvec2(slot, faceBit(q, b)) : across;
    oriented(isKept, edgePoint(two.cell, corners, face[a], face[b]), edgePoint(two.cell, corners, face[a], face[c]), own);
    oriented(isKept, edgePoint(two.cell, corners, face[b], face[a]), far, edgePoint(two.cell, corners, face[c], face[a]));
}

// Faces of a cell's tetrahedra that need triangles: bit 4 p + m.
uint facesParted(uint cell) {
    const uint word = complex[cell], all = partitions[cell];
    uint faces = 0u;
    [[dont_unroll]] for (uint p = 0u; p < tetrahedra; ++p) {
        const uint parts = hasTetrahedron(word, p) ? partsOf(labelsOf(partitionOf(all, p))) : 1u;
        faces |= (parts == 1u ? 0u : parts == 2u ? 1u : 15u) << 4u * p;
    }
    return faces;
}

// Faces of a slot that need filling, one bit each.
uint facesToFill(uint slot) {
    uint faces = 0u;
    [[dont_unroll]] for (uint q = 0u; q < 12u; ++q) faces |= uint(seenBoth(slot, q).isUnlike) << q;
    return faces;
}

// Loops over the set bits only: on a software device, code under a condition costs its time even if it does not run.
void addInside(uint cell) {
    [[dont_unroll]] for (uint left = facesParted(cell); left != 0u; left &= left - 1u) {
        const uint n = uint(findLSB(left)), p = n / 4u;
        partTetrahedron(cell, p, n % 4u, partitionOf(partitions[cell], p));
        writeNoted();
    }
    [[dont_unroll]] for (uint left = facesToFill(cell); left != 0u; left &= left - 1u) {
        fillFace(cell, uint(findLSB(left)));
        writeNoted();
    }
}
