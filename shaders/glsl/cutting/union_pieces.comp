#version 460
// Connected components, first half of a round: where the ends of a link have two labels, the higher label is attached
// to the lower, or to the lowest of several. Labels only decrease: all end as the lowest slot of their piece,
// whatever the order. If any labels still differed, another round runs.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define CUT_PUSH RoundPush
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) buffer Labels { uint labels[]; };
layout(std430, binding = 2) writeonly buffer Arguments { DispatchArguments arguments[]; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item, own = labels[i], owned = links[i] & OWNED_MASK;
    uint others[OWNED_LINKS];
    uint differ = 0u;
    [[unroll]] for (int k = 0; k < OWNED_LINKS; ++k) {
        const bool isLink = (owned >> FIRST_OWNED + k & 1u) != 0u; // else the node may not exist
        others[k] = labels[uint(int(i) + (isLink ? offsetOf(directionOf(FIRST_OWNED + k)) : 0))];
        differ |= uint(others[k] != own) << k;
    }
    if (differ == 0u) return;
    [[unroll]] for (int k = 0; k < OWNED_LINKS; ++k)
        if ((differ >> k & 1u) != 0u) atomicMin(labels[max(own, others[k])], min(own, others[k]));
    arguments[push.next].groupsX = push.groups;
}
