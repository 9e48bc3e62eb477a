// Part of count_contacts: the reach of a pair with a remaining overlap, its weight in shares, and the difference of a
// candidate. Requires the names and buffers of that kernel.
#include "common/share_band.h"

// Advances the recovery of a remaining overlap. Call it once a substep.
void recover(uint i, uint slot, vec3 x) {
    const float before = slips[slot].w;
    if (before == 0.0) return;
    const uvec2 candidate = CONTACT(slot);
    const float reach = uintBitsToFloat(candidate.y), overlap = reach - length(x - PREDICTED(candidate.x).xyz);
    if (before == reach) return; // interlocked bodies separate in passes of their own
    if (keepsRest && isKept(before)) {
        if (overlap <= -REST_SLACK * reach) slips[slot].w = 0.0;
        return;
    }
    const bool isOpened = canOpen && areParted(i, candidate.x);
    slips[slot].w = recovering(before, (isOpened ? min(push.recoverySpeed, CUT_RECOVERY_SPEED) : push.recoverySpeed) * step.h, overlap);
}

float reachOf(uint slot, float reach) {
    return hasRecovery ? reach - nearerBy(slips[slot].w) : reach;
}

// True if the candidate in a slot keeps its rest distance and its two particles have passed each other, at difference
// d. Without it, two particles in one place could not separate.
bool hasPassed(uint slot, vec3 d, vec3 velocity) {
    if (!hasRecovery) return false;
    const float reach = uintBitsToFloat(CONTACT(slot).y) - nearerBy(slips[slot].w);
    return keepsRest && isKept(slips[slot].w) && reach > 0.0 && passes(d, step.h * (velocity - VELOCITY(CONTACT(slot).x).xyz));
}

// The candidate in a slot.
struct Pair {
    vec3 d, way;
    float reach;
    bool areFree;
};

Pair pairOf(uint slot, vec4 x, vec3 velocity) {
    const uvec2 candidate = CONTACT(slot);
    const vec4 other = PREDICTED(candidate.x);
    return Pair(x.xyz - other.xyz, step.h * (velocity - VELOCITY(candidate.x).xyz),
                reachOf(slot, uintBitsToFloat(candidate.y)), areFreeOf(x.w, other.w));
}

// Weight in the shares of a particle of the candidate in a slot, at difference d, that it does not touch: 1 at the reach
// of the pair, 0 from (1 + SHARE_BAND) reach on. A pair that keeps its rest distance always is in that band: 0.
float weightOf(uint slot, vec3 d, float reach) {
    if (keepsRest && isKept(slips[slot].w)) return 0.0;
    const float within = reach * reach;
    return clamp(1.0 - (dot3(d, d) - within) / max((2.0 + SHARE_BAND) * SHARE_BAND * within, 1e-30), 0.0, 1.0);
}
