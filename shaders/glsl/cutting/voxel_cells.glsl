// Part of the kernels that tear voxel bodies: the links of the cell above a slot. Corner k of a cell: bit 0 in x, 1
// in y, 2 in z.
#include "lattice/link_masks.glsl"

#define CORNERS 8
#define Way vec3
const uint cellLinks = 28u, edgeLinks = 12u, stiffLinks = 24u; // edges first; stiffLinks: those that every body has, all but body diagonals

// End corners of a link, 8 x the first + the second: edges along x, y, z; across squares; across the cell.
const int cornersOfLink[28] = int[28](1, 19, 37, 55, 2, 11, 38, 47, 4, 13, 22, 31,
                                      3, 10, 39, 46, 5, 12, 23, 30, 6, 20, 15, 29, 7, 14, 21, 28);

ivec2 endsOf(uint l) { return ivec2(cornersOfLink[l] >> 3, cornersOfLink[l] & 7); }

ivec3 nodeOf(int corner) { return cornerOf(corner); }
uint slotOf(uint cell, int corner) {
    const ivec3 node = nodeOf(corner);
    return cell + uint(node.x) + uint(node.y) * push.rowStride + uint(node.z) * push.sliceStride;
}

// Bit of a link at the end that owns it, the first: corners ascend in z, then in y, then in x.
int bitOfLink(uint l) {
    const ivec2 ends = endsOf(l);
    const ivec3 way = nodeOf(ends.y) - nodeOf(ends.x);
    return bitOf(way.x, way.y, way.z);
}

bool isAliveIn(uint cell, uint l) { return (links[slotOf(cell, endsOf(l).x)] >> bitOfLink(l) & 1u) != 0u; }

// True if live links connect all corners.
bool isWhole(uint cell) {
    uint joined = 1u;
    for (uint before = 0u; before != joined;) {
        before = joined;
        for (uint l = 0u; l < stiffLinks; ++l) {
            const ivec2 ends = endsOf(l);
            const uint both = 1u << ends.x | 1u << ends.y;
            if (isAliveIn(cell, l) && (joined & both) != 0u) joined |= both;
        }
    }
    return joined == 255u;
}
