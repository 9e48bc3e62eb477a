// Part of the kernels that tear sheets: the links of the cell above a slot. Corner k of a cell: bit 0 in x, bit 1 in
// z.
#include "lattice/link_masks.glsl"

#define CORNERS 4
#define Way vec2
const uint cellLinks = 6u, edgeLinks = 4u; // edges first

// End corners of a link: edges along x, along z, diagonals.
ivec2 endsOf(uint l) { return l == 0u ? ivec2(0, 1) : l == 1u ? ivec2(2, 3) : l == 2u ? ivec2(0, 2) : l == 3u ? ivec2(1, 3) : l == 4u ? ivec2(0, 3) : ivec2(1, 2); }

ivec2 nodeOf(int corner) { return ivec2(corner & 1, corner >> 1); }
uint slotOf(uint cell, int corner) { return cell + uint(corner & 1) + uint(corner >> 1) * push.sliceStride; }

// Bit of a link at the end that owns it, the first: corners ascend in z, then in x.
int bitOfLink(uint l) {
    const ivec2 ends = endsOf(l), way = nodeOf(ends.y) - nodeOf(ends.x);
    return bitOf(way.x, 0, way.y);
}

bool isAliveIn(uint cell, uint l) { return (links[slotOf(cell, endsOf(l).x)] >> bitOfLink(l) & 1u) != 0u; }

// True if live links connect all corners.
bool isWhole(uint cell) {
    uint joined = 1u;
    for (uint round = 0u; round < 3u; ++round)
        for (uint l = 0u; l < cellLinks; ++l) {
            const ivec2 ends = endsOf(l);
            const uint both = 1u << ends.x | 1u << ends.y;
            if (isAliveIn(cell, l) && (joined & both) != 0u) joined |= both;
        }
    return joined == 15u;
}
