// How near two must be to touch where an overlap is still parting, and where a candidate is. In the names and buffers of
// count_contacts.
#ifdef HAS_RECOVERY
// Goes on with what is left of an overlap. Once a substep.
void recover(uint i, uint slot, vec3 x) {
    const float before = slips[slot].w;
    if (before == 0.0) return;
    const uvec2 candidate = CONTACT(slot);
    const float reach = uintBitsToFloat(candidate.y), overlap = reach - length(x - PREDICTED(candidate.x).xyz);
    if (before == reach) return; // interlocked bodies part in passes of their own
    if (keepsRest && isKept(before)) {
        if (overlap <= -REST_SLACK * reach) slips[slot].w = 0.0;
        return;
    }
    const bool isOpened = canOpen && areParted(i, candidate.x);
    slips[slot].w = recovering(before, (isOpened ? min(push.recoverySpeed, CUT_RECOVERY_SPEED) : push.recoverySpeed) * step.h, overlap);
}
#endif

float reachOf(uint slot, float reach) {
#ifdef HAS_RECOVERY
    return reach - nearerBy(slips[slot].w);
#else
    return reach;
#endif
}

// Whether the candidate in a slot keeps its rest distance and has passed itself, at difference d. Two in one place have no way out.
bool hasPassed(uint slot, vec3 d, vec3 velocity) {
#ifdef HAS_RECOVERY
    const float reach = uintBitsToFloat(CONTACT(slot).y) - nearerBy(slips[slot].w);
    return keepsRest && isKept(slips[slot].w) && reach > 0.0 && passes(d, step.h * (velocity - VELOCITY(CONTACT(slot).x).xyz));
#else
    return false;
#endif
}

// Of the candidate in a slot.
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
