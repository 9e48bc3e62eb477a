// Part of gather_split.comp: terms for scenes with bends or damping.
layout(constant_id = 12) const bool hasDamping = false;

// A damper along a link, [kg m]: the kick divides by h^2 as for springs, so its coefficient c = dampingTime x
// stiffness is passed as c h. Equal and opposite at both ends to the bit: d and the relative velocity change sign, d
// d^T does not. The clamp keeps h c D below step.dampingShare x omega, with which every mode is stable (substeps.hpp:
// dampingBudget).
vec3 dampingImpulse(vec3 d, vec3 relative, float stiffness, float most, float h) {
    const float coefficient = min(push.dampingTime * stiffness * h, step.dampingShare * most);
    return h * coefficient * dot(relative, d) / (dot(d, d) + 1e-30) * d;
}

#ifdef LINKS_RANGED
#define BEND_BINDING (LINK_BINDING + 2)
#else
#define BEND_BINDING (LINK_BINDING + 1)
#endif
layout(constant_id = 6) const uint bendDegree = 0; // slots per particle, padded
layout(std430, binding = BEND_BINDING) readonly buffer Bends { SplitBend bends[]; };

// The sum over bends of -g_i k C(y) h^2 [kg m], C = y_a - 2 y_b + y_c, g_i its gradient. All three particles of a bend
// evaluate the same C, so that the impulses -1, 2, -1 x k C add up to 0.
vec3 bendImpulses(uint i, float hh) {
    vec3 sum = vec3(0.0);
    [[unroll]] for (uint s = 0u; s < bendDegree; ++s) {
        const SplitBend bend = bends[(i / LINK_BLOCK * bendDegree + s) * LINK_BLOCK + i % LINK_BLOCK];
        const vec3 b = POSITION(bend.b).xyz;
        const vec3 c = (POSITION(bend.a).xyz - b) + (POSITION(bend.c).xyz - b);
        sum += bend.weight * min(bend.stiffness * hh, bend.clamp) * c;
    }
    return sum;
}
