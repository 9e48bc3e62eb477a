// Where the points of a cut surface stand in their list. Every slot owns the points on its seven links that are edges of the
// complex (kuhn.glsl), on twelve faces of the cell above it, and in that cell's tetrahedra. A bit says that a point exists:
//
//   0 .. 13    edges: 2 (d - 1) + end, d = 1 .. 7 the direction as a corner; only end 0 where both sides are one (16 + d - 1)
//   32 .. 67   faces: 32 + 3 q + place of the lowest corner that this copy hangs on; q = p: the low face of tetrahedron p,
//              then the three between p and (j, i, k), the three between p and (i, k, j)
//   68 .. 91   middles of tetrahedra: 68 + 4 p + lowest corner of the part
//
// and mergeBit(q) that the third corner of a face hangs on the second, where it has no copy of its own.

const uvec3 existing = uvec3(0x3fffu, 0xffffffffu, 0x0fffffffu); // of the words, that are points
const uint firstFace = 32u, firstMiddle = 68u;

uint weldBit(uint direction) { return 15u + direction; }
uint edgeBit(uint direction, uint end) { return 2u * direction - 2u + end; }
uint faceBit(uint q, uint place) { return firstFace + 3u * q + place; }
uint mergeBit(uint q) { return q < 9u ? 23u + q : 83u + q; }
uint middleBit(uint p, uint label) { return firstMiddle + 4u * p + label; }

bool hasBit(uvec4 owned, uint bit) { return (owned[bit >> 5] >> (bit & 31u) & 1u) != 0u; }
void setBit(inout uvec4 owned, uint bit) { owned[bit >> 5] |= 1u << (bit & 31u); }

uint countOf(uvec4 owned) {
    const ivec3 counts = bitCount(owned.xyz & existing);
    return uint(counts.x + counts.y + counts.z);
}

// The copy that stands for a point: of an edge where both sides are one, of a face where corners hang together.
uint copyOf(uvec4 owned, uint bit) {
    if (bit < 14u) return hasBit(owned, weldBit((bit >> 1) + 1u)) ? bit & ~1u : bit;
    if (bit < firstFace || bit >= firstMiddle || hasBit(owned, bit)) return bit;
    const uint q = (bit - firstFace) / 3u, place = (bit - firstFace) % 3u;
    return faceBit(q, place == 2u && hasBit(owned, mergeBit(q)) ? 1u : 0u);
}

// The place of a point in the list; w is that of the slot's first.
uint placeOf(uvec4 owned, uint bit) {
    const uint below = (1u << (bit & 31u)) - 1u, word = bit >> 5;
    const uvec3 all = owned.xyz & existing;
    uint place = owned.w + uint(bitCount(all[word] & below));
    if (word > 0u) place += uint(bitCount(all.x));
    if (word > 1u) place += uint(bitCount(all.y));
    return place;
}

// Which face of which slot the one opposite of corner m of tetrahedron p is.
struct Face {
    uint slot, q;
};
const uint pairSecond[6] = uint[6](6u, 7u, 6u, 8u, 7u, 8u), pairThird[6] = uint[6](9u, 9u, 10u, 10u, 11u, 11u);

Face ownerOf(uint cell, uint p, uint m) {
    if (m == 0u) return Face(slotOf(cell, secondCorner[p]), beyondFirst[p]);
    return Face(cell, m == 1u ? pairSecond[p] : m == 2u ? pairThird[p] : p);
}

// The tetrahedra on both sides of a face that a slot owns.
struct Side {
    uint cell, p, m;
};

Side firstSide(uint slot, uint q) {
    const uint p = q < 6u ? q : q < 9u ? uint[3](0u, 1u, 3u)[q - 6u] : 2u * (q - 9u);
    return Side(slot, p, q < 6u ? 3u : q < 9u ? 1u : 2u);
}

Side secondSide(uint slot, uint q) {
    const Side first = firstSide(slot, q);
    if (first.m == 1u) return Side(slot, beyondSecond[first.p], 1u);
    if (first.m == 2u) return Side(slot, beyondThird[first.p], 2u);
    return Side(slot - slotOf(0u, 1u << lastAxis[q]), beyondLast[q], 0u);
}

// The point on the edge between corners a and b of a tetrahedron, on the side of a.
uvec2 edgePoint(uint cell, uvec4 corners, uint a, uint b) {
    const uint low = corners[min(a, b)], direction = low ^ corners[max(a, b)];
    return uvec2(slotOf(cell, low), edgeBit(direction, a < b ? 0u : 1u));
}
