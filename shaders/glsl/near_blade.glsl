// Part of the kernels that find what is near the blade of a step. Whoever includes this has before[], blade, and PLACE(i), where a
// slot's particle is; or says what BEFORE(i) is.
#ifndef BEFORE
#define BEFORE(i) before[i]
#endif

// Where the particle of a slot was when the edge was where it now begins.
vec3 placeBefore(uint i) {
    if (blade.isCarried == 0u) return PLACE(i);
    const vec4 then = BEFORE(i);
    return then.w > 0.0 ? then.xyz : PLACE(i);
}

const float skinReach = 2.5; // of what goes with a particle [cells]

bool isNearBlade(uint i) {
    const vec3 now = PLACE(i), then = placeBefore(i);
    return all(lessThanEqual(min(now, then) - skinReach * push.spacing, blade.high.xyz)) &&
           all(greaterThanEqual(max(now, then) + skinReach * push.spacing, blade.low.xyz));
}
