// Part of face_search: pairs of a point and a face that links exclude. Requires its names.
#include "collision/excluded.glsl"

// Links between a point and the corners of a face: none; only diagonals, so that the contact distance is
// LINKED_REACH; or links that exclude the contact.
#define BOND_NONE 0u
#define BOND_DIAGONAL 1u
#define BOND_EXCLUDED 2u

layout(constant_id = 1) const bool hasLinks = false; // a body may be cut
layout(std430, binding = LINKS_BINDING) readonly buffer Links { uint links[]; }; // live links of each lattice node
#include "lattice/link_masks.glsl"
#include "lattice/link_ways.glsl"

// Finds the links between a point and a face. The row of a body that may be cut ends with the position of its strides
// in the table, where a further entry says whether diagonal links permit contacts.
uint bondOf(Searched face, uint i) {
    if (isExcluded(face.index, i)) return BOND_EXCLUDED;
    if (!hasLinks) return BOND_NONE;
    const uint end = EXCLUDED(face.index + 1u), last = end > EXCLUDED(face.index) ? EXCLUDED(end - 1u) : 0u;
    if ((last & EXCLUDED_LINKED) == 0u) return BOND_NONE;
    const uint strides = last & ~EXCLUDED_LINKED, rowStride = EXCLUDED(strides), sliceStride = EXCLUDED(strides + 1u);
    uint alive = 0u;
    [[dont_unroll]] for (uint c = 0u; c < 3u; ++c) {
        const uint corner = c == 0u ? face.face.a : c == 1u ? face.face.b : face.face.c;
        alive |= links[corner] & linksTo(int(i) - int(corner), rowStride, sliceStride);
    }
    if (alive == 0u) return BOND_NONE;
    return (alive & EDGE_LINKS) != 0u || EXCLUDED(strides + 2u) == 0u ? BOND_EXCLUDED : BOND_DIAGONAL;
}
