// Part of advance_substep: the warm start of a substep from the multipliers of the one before.

// The sum of l n over a particle's links [kg m]. An end a moves against n, an end b along it: both by the same bits.
// Slots without a link point to padding of the constraint list, whose multipliers stay 0.
vec3 warmImpulses(uint i) {
    vec3 sum = vec3(0.0);
    [[unroll]] for (uint s = 0u; s < degree; ++s) {
        const uint link = LINK((i / LINK_BLOCK * degree + s) * LINK_BLOCK + i % LINK_BLOCK);
        const vec3 impulse = MULTIPLIER(link & ~WARM_LINK_SIGN).xyz;
        sum += (link & WARM_LINK_SIGN) != 0u ? -impulse : impulse;
    }
    return push.isFirst != 0u ? step.multiplierScale * sum : sum;
}
