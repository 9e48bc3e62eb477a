#version 460
// Ends a step for interlocked bodies: a pair whose overlaps stayed below a tenth of a radius during the whole step
// has separated, and one step later its contacts are ordinary ones. An undone step changes nothing. One group.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Status { StatusWords status; };
layout(std430, binding = 1) buffer Pairs { InterlockPair pairs[]; };
layout(std430, binding = 2) writeonly buffer Arguments { DispatchArguments arguments[]; };
layout(push_constant) uniform Push { InterlockPush push; };
shared uint remaining;

uint stateAfter(InterlockPair pair) {
    const bool isSeen = pair.deepest > 0u; // an awake particle of the pair was processed
    if (pair.state == INTERLOCK_LEFT && isSeen) return INTERLOCK_APART;
    return isSeen && uintBitsToFloat(pair.deepest) < INTERLOCK_SHALLOW && pair.state == INTERLOCK_PARTING ? INTERLOCK_LEFT : pair.state;
}

void main() {
    const uint lane = itemIndex(GROUP_SIZE);
    const bool stays = isFinished(status);
    if (lane == 0u) remaining = 0u;
    barrier();
    for (uint p = lane; p < push.pairs; p += GROUP_SIZE) {
        const uint state = stays ? stateAfter(pairs[p]) : pairs[p].state;
        pairs[p] = InterlockPair(state, 0u);
        if (state != INTERLOCK_APART) atomicOr(remaining, 1u);
    }
    barrier();
    if (lane == 0u) arguments[0] = DispatchArguments(remaining * push.count / GROUP_SIZE, 1u, 1u, 0u);
}
