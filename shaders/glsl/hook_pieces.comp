#version 460
// Connected components, first half of a round: where the ends of a link have two labels, the higher hangs on the lower, on the
// lowest where there are several. Labels only become smaller: all end with the lowest slot of their piece, whatever the order.
#extension GL_GOOGLE_include_directive : require
#include "cut.glsl"
#include "link_masks.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) buffer Labels { uint labels[]; };
layout(std430, binding = 2) buffer Work { CutWork work; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item, own = labels[i];
    bool isNew = false;
    for (uint owned = links[i] & OWNED_MASK; owned != 0u; owned &= owned - 1u) {
        const uint other = labels[uint(int(i) + offsetOf(directionOf(findLSB(owned))))];
        if (other == own) continue;
        atomicMin(labels[max(own, other)], min(own, other));
        isNew = true;
    }
    if (isNew) work.changed = 1u;
}
