// Masks of the live links of a node (src/sim/lattice/link_masks.hpp): bit b is the link in the direction of step s, s
// = x + 1 + 3 (y + 1) + 9 (z + 1), where the zero step is left out. At the other end the link is bit 25 - b. Bits
// from FIRST_OWNED on lead to higher nodes (z, then y, then x): the node owns those links.
#define FIRST_OWNED 13
#define OWNED_LINKS 13
#define OWNED_MASK 0x3ffe000u

int bitOf(int dx, int dy, int dz) {
    const int s = dx + 1 + 3 * (dy + 1) + 9 * (dz + 1);
    return s < FIRST_OWNED ? s : s - 1;
}

// Links along the axes.
#define EDGE_LINKS (1u << 4 | 1u << 10 | 1u << 12 | 1u << 13 | 1u << 15 | 1u << 21)

// Offset of corner k of a box.
ivec3 cornerOf(int k) { return ivec3(k & 1, k >> 1 & 1, k >> 2); }

bool isAlive(uint links, int dx, int dy, int dz) { return (links >> bitOf(dx, dy, dz) & 1u) != 0u; }

// Connectivity of three corners by the links between them: for each the lowest index of its part.
uvec3 patternOf(bool ab, bool bc, bool ca) {
    return uvec3(0u, ab || bc && ca ? 0u : 1u, ca || ab && bc ? 0u : bc ? 1u : 2u);
}

ivec3 directionOf(int bit) {
    const int s = bit < FIRST_OWNED ? bit : bit + 1;
    return ivec3(s % 3, s / 3 % 3, s / 9) - 1;
}

// The bit of the link that leads to the slot `slots` further; -1 if none does. In a sheet, rowStride 0, there is no
// y.
int bitTo(int slots, uint rowStride, uint sliceStride) {
    for (int bit = 0; bit < FIRST_OWNED + OWNED_LINKS; ++bit) {
        const ivec3 d = directionOf(bit);
        const bool isInSheet = d.y == 0 || rowStride > 0u;
        if (isInSheet && d.x + d.y * int(rowStride) + d.z * int(sliceStride) == slots) return bit;
    }
    return -1;
}

// Index of an owned link among the seven that are edges of Kuhn's tetrahedra, in the order of their bits; -1 for the
// others. (1,0,0) (0,1,0) (1,1,0) (0,0,1) (1,0,1) (0,1,1) (1,1,1)
int kuhnIndexOf(int bit) {
    const ivec3 d = directionOf(bit);
    return any(lessThan(d, ivec3(0))) ? -1 : d.x + 2 * d.y + 4 * d.z - 1;
}
