#version 460
// Rule K: makes the links of the solver agree with Kuhn's tetrahedra, which the surface of a cut is made of. A link that is no edge of
// theirs, or has no stiffness, dies unless its ends hang together by stiff edges within its own square or cell. The rule clears
// no bit that it asks for, so it may read while others clear.
#extension GL_GOOGLE_include_directive : require
#include "cut.glsl"
#include "link_masks.glsl"

layout(std430, binding = 0) buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer Dirty { uint dirty[]; };

// Corner c of the box between the ends of a link: along axis k at the higher end where bit k is set. Flat boxes have no axis there.
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
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item;
    if (dirty[i >> 5] == 0u) return;
    const uint owned = links[i] & OWNED_MASK;
    uint cut = 0u;
    for (int bit = FIRST_OWNED; bit < FIRST_OWNED + OWNED_LINKS; ++bit) {
        const bool isEdge = kuhnIndexOf(bit) >= 0 && (push.stiffLinks >> bit & 1u) != 0u;
        if (isEdge || (owned >> bit & 1u) == 0u || areJoined(i, bit)) continue;
        cut |= 1u << bit;
        atomicAnd(links[uint(int(i) + offsetOf(directionOf(bit)))], ~(1u << 25 - bit));
    }
    if (cut != 0u) atomicAnd(links[i], ~cut);
}
