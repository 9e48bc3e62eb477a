// The owners of the points of a tetrahedron (surface_points.glsl), and the tetrahedra around an owned face.
#include "surface/surface_points.glsl"

// Owner slot and number of the face opposite of corner m of tetrahedron p.
struct Face {
    uint slot, q;
};
const uint pairSecond[6] = uint[6](6u, 7u, 6u, 8u, 7u, 8u), pairThird[6] = uint[6](9u, 9u, 10u, 10u, 11u, 11u);

Face ownerOf(uint cell, uint p, uint m) {
    if (m == 0u) return Face(slotOf(cell, secondCorner[p]), beyondFirst[p]);
    return Face(cell, m == 1u ? pairSecond[p] : m == 2u ? pairThird[p] : p);
}

// One side of a face that a slot owns: a tetrahedron, and its corner opposite of the face.
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
