// Part of mark_points: finds the points of an edge and of a face. There is a point for each part that a tetrahedron
// or prism has separated there, and one for several parts if another one around connects them. Requires the names of
// that kernel.

// Applies the prisms on the two faces of a tetrahedron at the edge from corner a to b.
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
        const uint a = uint(bitCount(low)), b = uint(bitCount(low | d)); // corners of a path have 0, 1, 2, 3 bits
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
