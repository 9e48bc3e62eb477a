// Part of the kernels that find what is near the blade of a step. Whoever includes this has before[], blade, and PLACE(i), where a
// slot's particle is; or says what BEFORE(i) is.
#ifndef NEAR_BLADE_GLSL
#define NEAR_BLADE_GLSL
#ifndef BEFORE
#define BEFORE(i) before[i]
#endif

// Where the particle of a slot was when the edge was where it now begins.
vec3 placeBefore(uint i) {
    if (blade.isCarried == 0u) return PLACE(i);
    const vec4 then = BEFORE(i);
    return then.w > 0.0 ? then.xyz : PLACE(i);
}
#endif
