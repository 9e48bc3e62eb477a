// Indices of the points of a cut surface in their list. Every slot owns the points on its seven links that are edges
// of the complex (kuhn.glsl), on twelve faces of the cell above it, and in that cell's tetrahedra. A bit marks a
// point that exists:
//
//   0 .. 13    edges: 2 (d - 1) + end, d = 1 .. 7 the direction as a corner; only end 0 where both sides are one (16 + d - 1)
//   32 .. 67   faces: 32 + 3 q + index of the lowest corner that this copy is bound to; q = p: the low face of tetrahedron p,
//              then the three between p and (j, i, k), the three between p and (i, k, j)
//   68 .. 91   centres of tetrahedra: 68 + 4 p + lowest corner of the part
//
// mergeBit(q): the third corner of a face without a copy of its own is bound to that of the second.

const uvec3 existing = uvec3(0x3fffu, 0xffffffffu, 0x0fffffffu); // bits of the words that are points
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

// The copy that represents a point: shared on an edge whose sides are one, and on a face with connected corners.
uint copyOf(uvec4 owned, uint bit) {
    if (bit < 14u) return hasBit(owned, weldBit((bit >> 1) + 1u)) ? bit & ~1u : bit;
    if (bit < firstFace || bit >= firstMiddle || hasBit(owned, bit)) return bit;
    const uint q = (bit - firstFace) / 3u, place = (bit - firstFace) % 3u;
    return faceBit(q, place == 2u && hasBit(owned, mergeBit(q)) ? 1u : 0u);
}

// Index of a point in the list; w is that of the slot's first point.
uint placeOf(uvec4 owned, uint bit) {
    const uint below = (1u << (bit & 31u)) - 1u, word = bit >> 5;
    const uvec3 all = owned.xyz & existing;
    uint place = owned.w + uint(bitCount(all[word] & below));
    if (word > 0u) place += uint(bitCount(all.x));
    if (word > 1u) place += uint(bitCount(all.y));
    return place;
}
