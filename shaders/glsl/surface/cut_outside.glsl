// The outer triangles of a cut in one cell: pieces of the cell's outer faces, and whole faces with the points on
// their edges inserted, so that no gap opens beside a piece. The points are those of cut_inside. The including kernel
// defines
//
//   triangle(a, b, c)   points as (slot, bit), right-handed seen from outside; corner() for a particle
//   writeNoted()        writes the triangles since the last call, 6 at most
//   hasPoint(a)         true if the point exists
//   setNormal(axis, isHigh)   sets the normal of the triangles that follow

const uint particleBit = 128u;
uvec2 corner(uint cell, uint at) { return uvec2(slotOf(cell, at), particleBit); }

// A connected face with points on some of its edges: bit n = between n and the next. Returns the number of triangles.
uint outsideWhole(uvec2 at[3], uvec2 on[3], uint used) {
    if (used == 0u) return 0u;
    const uint count = uint(bitCount(used));
    const uint first = count == 2u ? uint[8](0u, 0u, 0u, 0u, 0u, 2u, 1u, 0u)[used] : uint(findLSB(used));
    const uint second = (first + 1u) % 3u, third = (first + 2u) % 3u;
    if (count == 3u) {
        [[dont_unroll]] for (uint n = 0u; n < 3u; ++n) triangle(at[n], on[n], on[(n + 2u) % 3u]);
        triangle(on[0], on[1], on[2]);
        return 4u;
    }
    triangle(on[first], at[second], count == 2u ? on[second] : at[third]);
    if (count == 2u) triangle(on[first], on[second], at[third]);
    triangle(on[first], at[third], at[first]);
    return count + 1u;
}

// A face with corner a cut off. Returns the number of triangles.
uint outsideTwo(uvec2 at[3], uvec2 ownB, uvec2 ownC, uvec2 farB, uvec2 farC, uvec2 between, bool isBetween) {
    triangle(at[0], ownB, ownC);
    triangle(farB, at[1], isBetween ? between : at[2]);
    triangle(farB, isBetween ? between : at[2], farC);
    if (isBetween) triangle(between, at[2], farC);
    return isBetween ? 4u : 3u;
}

uint outsideFace(uint cell, uint p, uint m, uint parted) {
    const uvec4 corners = cornersOf(p), labels = labelsOf(parted);
    uvec3 face = faceOf(m);
    const uvec3 pattern = restricted(labels, face);
    const uint ways = waysOf(pattern), lone = ways == 2u ? loneOf(pattern) : 0u;
    const Face owner = ownerOf(cell, p, m);
    const uint turn = isOutward(p, m) ? 1u : 2u;
    const uvec3 place = uvec3(lone, (lone + turn) % 3u, (lone + 2u * turn) % 3u); // right-handed, beginning with the corner that is alone
    face = uvec3(face[place.x], face[place.y], face[place.z]);
    uvec2 at[3], on[3], off[3]; // corners; points between n and the next, on the side of n and on that of the next
    uint used = 0u;
    [[dont_unroll]] for (uint n = 0u; n < 3u; ++n) {
        at[n] = corner(cell, corners[face[n]]);
        on[n] = edgePoint(cell, corners, face[n], face[(n + 1u) % 3u]);
        off[n] = edgePoint(cell, corners, face[(n + 1u) % 3u], face[n]);
        if (hasPoint(on[n])) used |= 1u << n;
    }
    if (ways == 1u) return outsideWhole(at, on, used);
    if (ways == 2u) return outsideTwo(at, on[0], off[2], off[0], on[2], on[1], (used & 2u) != 0u);
    [[dont_unroll]] for (uint n = 0u; n < 3u; ++n) {
        const uvec2 middle = uvec2(owner.slot, faceBit(owner.q, place[n]));
        triangle(at[n], on[n], middle);
        triangle(at[n], middle, off[(n + 2u) % 3u]);
    }
    return 6u;
}

// True if a face of a tetrahedron is an outer one: that opposite of corner 0 (side 0) or of 3 (side 1).
bool isOuter(uint cell, uint p, uint side) {
    const uint next = side == 0u ? slotOf(cell, secondCorner[p]) : cell - slotOf(0u, 1u << lastAxis[p]);
    return !isCell(complex[next]);
}

// Adds the outer triangles of a cell, and returns the outer faces that are drawn in pieces: bit 2 p for the face
// opposite of 0, 2 p + 1 for that of 3.
uint addOutside(uint cell) {
    if ((complex[cell] & COMPLEX_HAS_FACES) == 0u) return 0u;
    uint pieces = 0u;
    [[dont_unroll]] for (uint p = 0u; p < tetrahedra; ++p)
        [[dont_unroll]] for (uint side = 0u; side < 2u; ++side) {
            if (!isOuter(cell, p, side)) continue;
            setNormal(side == 0u ? secondCorner[p] : 1u << lastAxis[p], side == 0u);
            if (outsideFace(cell, p, 3u * side, partitionOf(partitions[cell], p)) > 0u) pieces |= 1u << 2u * p + side;
            writeNoted();
        }
    return pieces;
}
