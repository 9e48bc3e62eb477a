#version 460
// Links of the solver after a cut: made consistent with Kuhn's tetrahedra, which form the surfaces of cuts. A link
// that is no edge of a tetrahedron, or has no stiffness, is cut unless its ends are connected by stiff edges within
// its own square or cell. No bit that is read is cleared here, so invocations may read while others clear.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"

layout(std430, binding = 0) buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer Dirty { uint dirty[]; };
layout(std430, binding = 2) readonly buffer Counts { uint listedCounts[]; };
layout(std430, binding = 3) readonly buffer Listed { uint listed[]; };
#include "lattice/dirty.glsl"
#include "common/listed_slot.glsl"

const int across[3] = int[3](14, 18, 20); // links across squares that are no edges: (-1,1,0) (0,-1,1) (-1,0,1)

uint stiffLinksOf(uint slot) { return links[slot] & push.stiffLinks; }

bool has(uint word, ivec3 direction) { return isAlive(word, direction.x, direction.y, direction.z); }

// True if corners a and b of a square are connected; `first` and `second` lead from its lowest corner to them. The
// path is around the lowest or the highest corner, or over the diagonal between those, which is an edge.
bool areJoinedAcross(uint low, uint a, uint b, ivec3 first, ivec3 second) {
    const bool toA = has(low, first), toB = has(low, second), fromA = has(a, second), fromB = has(b, first);
    return toA && toB || fromA && fromB || has(low, first + second) && (toA && fromB || toB && fromA);
}

// Among the three links across squares of node i, whose links are `owned`: those whose ends are no longer connected.
uint partedAcross(uint i, uint owned) {
    const uint own = stiffLinksOf(i);
    uint parted = 0u;
    [[unroll]] for (int k = 0; k < 3; ++k) {
        const ivec3 direction = directionOf(across[k]), back = max(-direction, ivec3(0)), ahead = max(direction, ivec3(0));
        const bool isLink = (owned >> across[k] & 1u) != 0u; // else the square may not exist
        const uint low = stiffLinksOf(i - uint(isLink ? offsetOf(back) : 0));
        const uint end = stiffLinksOf(uint(int(i) + (isLink ? offsetOf(direction) : 0)));
        if (isLink && !areJoinedAcross(low, own, end, back, ahead)) parted |= 1u << across[k];
    }
    return parted;
}

// True if the ends of a link are connected within the box between them. Corner c of the box is at the higher end of
// axis k if bit k is set; flat boxes lack that axis.
bool areJoined(uint i, int bit) {
    const ivec3 direction = directionOf(bit), lowest = min(direction, ivec3(0));
    const int axes = (direction.x != 0 ? 1 : 0) | (direction.y != 0 ? 2 : 0) | (direction.z != 0 ? 4 : 0);
    uint words[8];
    for (int c = 0; c < 8; ++c)
        words[c] = (c & axes) == c ? links[uint(int(i) + offsetOf(lowest + cornerOf(c)))] & push.stiffLinks : 0u;
    uint reached = 1u << ((lowest.x < 0 ? 1 : 0) | (lowest.y < 0 ? 2 : 0) | (lowest.z < 0 ? 4 : 0)); // i itself
    const uint goal = uint(axes ^ findLSB(reached));
    for (uint before = 0u; before != reached;) {
        before = reached;
        for (int c = 0; c < 8; ++c)
            for (int m = 1; m < 8; ++m) {
                if ((m & axes) != m || (c & m) != 0 || !isAlive(words[c], m & 1, m >> 1 & 1, m >> 2)) continue;
                const uint ends = 1u << c | 1u << (c | m);
                if ((reached & ends) != 0u) reached |= ends;
            }
    }
    return (reached >> goal & 1u) != 0u;
}

void main() {
    const uint i = listedSlot();
    if (i == NO_SLOT || !isDirty(i)) return;
    const uint owned = links[i] & OWNED_MASK;
    uint cut = partedAcross(i, owned), others = owned;
    [[unroll]] for (int bit = FIRST_OWNED; bit < FIRST_OWNED + OWNED_LINKS; ++bit) {
        const bool isAcross = bit == across[0] || bit == across[1] || bit == across[2];
        if (isAcross || kuhnIndexOf(bit) >= 0 && (push.stiffLinks >> bit & 1u) != 0u) others &= ~(1u << bit);
    }
    for (; others != 0u; others &= others - 1u)
        if (!areJoined(i, findLSB(others))) cut |= others & -others;
    for (uint rest = cut; rest != 0u; rest &= rest - 1u) {
        const int bit = findLSB(rest);
        atomicAnd(links[uint(int(i) + offsetOf(directionOf(bit)))], ~(1u << 25 - bit));
    }
    if (cut != 0u) atomicAnd(links[i], ~cut);
}
