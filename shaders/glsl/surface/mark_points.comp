#version 460
// The surface of a cut, second pass: finds the points that exist. An edge between two parts of a tetrahedron has a
// point for each end, or one for both if another tetrahedron connects the ends: that closes the front of a cut
// without a gap and without a search. The same holds for a face split in three; a tetrahedron with three or four
// parts has points at its centre.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"
#include "lattice/kuhn.glsl"
#include "surface/cut_points.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer Complex { uint complex[]; };
layout(std430, binding = 2) readonly buffer ListedCounts { uint listedCounts[]; };
layout(std430, binding = 3) readonly buffer Partitions { uint partitions[]; };
layout(std430, binding = 4) writeonly buffer Owned { uvec4 owned[]; };
layout(std430, binding = 5) readonly buffer Listed { uint listed[]; };
#include "common/listed_slot.glsl"

#include "surface/seen_faces.glsl"
#include "surface/needed_points.glsl"

// True if a tetrahedron at a node is split, or a prism may be.
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
