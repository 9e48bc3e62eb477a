// The tetrahedra that surfaces of cuts are made of: every cell is six tetrahedra (Kuhn), one for each order in which
// a path along the axes leads from its lowest corner to its highest. All their edges are links.
//
//   tetrahedron p   order (i, j, k) of axes: 012 021 102 120 201 210; corners 0, 1 << i, 1 << i | 1 << j, 7 of the cell
//   opposite of 0   on the cell's high face along i; beyond lies (j, k, i) of the next cell, there opposite of 3
//   opposite of 1   beyond lies (j, i, k) of the same cell; opposite of 2: (i, k, j)
//   opposite of 3   on the low face along k; beyond lies (k, i, j) of the cell before, there opposite of 0
//
// Both sides see the corners of a face in the same order. A partition groups the corners of a tetrahedron that are
// connected by live links: for each corner the lowest one of its part, in 0, 1, 2 and 2 bits; 0 = all are connected.

const uint tetrahedra = 6u, partitionBits = 5u;
const uint secondCorner[6] = uint[6](1u, 1u, 2u, 2u, 4u, 4u), thirdCorner[6] = uint[6](3u, 5u, 3u, 6u, 5u, 6u);
const uint beyondFirst[6] = uint[6](3u, 5u, 1u, 4u, 0u, 2u);  // (j, k, i)
const uint beyondSecond[6] = uint[6](2u, 4u, 0u, 5u, 1u, 3u); // (j, i, k)
const uint beyondThird[6] = uint[6](1u, 0u, 3u, 2u, 5u, 4u);  // (i, k, j)
const uint beyondLast[6] = uint[6](4u, 2u, 5u, 0u, 3u, 1u);   // (k, i, j)
const uint lastAxis[6] = uint[6](2u, 1u, 2u, 0u, 1u, 0u);
const bool isEven[6] = bool[6](true, false, false, true, true, false); // its corners in order are right-handed

// The four or six tetrahedra around the edge from a node in direction d, each twice if four: c + 8 p, where the node
// is corner c of the cell.
const uint aroundEdge[42] = uint[42](0u, 8u, 18u, 36u, 30u, 46u, 16u, 24u, 1u, 44u, 13u, 37u, 0u, 16u, 36u, 44u, 0u, 16u, 32u, 40u, 9u, 26u, 3u,
                                     19u, 8u, 32u, 18u, 26u, 8u, 32u, 24u, 40u, 1u, 9u, 24u, 40u, 0u, 8u, 16u, 24u, 32u, 40u);
uint aroundOf(uint d, uint n) { return aroundEdge[6u * (d - 1u) + n]; }

uvec4 cornersOf(uint p) { return uvec4(0u, secondCorner[p], thirdCorner[p], 7u); }

// Bits of a complex word (COMPLEX_FACES): tetrahedra inside of a surface, and prisms that stand on a face or an edge.
bool hasTetrahedron(uint word, uint p) { return (word >> p & 1u) != 0u; }
bool hasPrisms(uint word, uint q) { return (word >> COMPLEX_FACES + q & 1u) != 0u; }
bool hasThinPrisms(uint word, uint direction) { return (word >> COMPLEX_EDGES + direction - 1u & 1u) != 0u; }
bool isCell(uint word) { return (word & COMPLEX_IS_CELL) != 0u; }

// The slot of a cell's corner.
uint slotOf(uint cell, uint corner) { return uint(int(cell) + offsetOf(cornerOf(int(corner)))); }

uint partitionOf(uint word, uint p) { return bitfieldExtract(word, int(partitionBits * p), int(partitionBits)); }
uvec4 labelsOf(uint parted) { return uvec4(0u, parted & 1u, parted >> 1 & 3u, parted >> 3); }

// Number of parts of a tetrahedron.
uint partsOf(uvec4 labels) {
    return 1u + (labels.y == 1u ? 1u : 0u) + (labels.z == 2u ? 1u : 0u) + (labels.w == 3u ? 1u : 0u);
}

// The corners of the face opposite of corner m, in order.
uvec3 faceOf(uint m) { return uvec3(m == 0u ? 1u : 0u, m <= 1u ? 2u : 1u, m <= 2u ? 3u : 2u); }

// True if the corners of that face, in order, are right-handed seen from outside.
bool isOutward(uint p, uint m) { return isEven[p] == ((m & 1u) == 0u); }

// A partition restricted to the three corners of a face: for each the lowest index of its part.
uvec3 restricted(uvec4 labels, uvec3 face) {
    const uint a = labels[face.x], b = labels[face.y], c = labels[face.z];
    return uvec3(0u, a == b ? 0u : 1u, c == a ? 0u : c == b ? 1u : 2u);
}

uint waysOf(uvec3 pattern) { return 1u + (pattern.y == 1u ? 1u : 0u) + (pattern.z == 2u ? 1u : 0u); }

// Index of the corner that is alone, in a face split in two.
uint loneOf(uvec3 pattern) { return pattern.y == 0u ? 2u : pattern.z == 0u ? 1u : 0u; }
