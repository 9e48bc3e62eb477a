// Part of advance_substep: what becomes of a particle whose substep has been swept (methods: D; contacts: 0.4).

layout(constant_id = 11) const bool hasColliders = false; // planes come before those (touch_planes), not here

// Turns the end of a sweep into the velocity after the substep, and returns the way from p to the position after it.
// `remainder` is the part of the corrections with which the substep opened.
vec3 close(uint i, vec3 halfKick, vec3 p, vec3 remainder, inout vec3 v) {
    vec3 way = uintBitsToFloat(corrections[i].xyz);
    const vec3 before = v - 2.0 * halfKick;
    v += (way - remainder) / step.h;
#ifdef HAS_PLANES
    const vec3 x = p + way;
    Motion motion = Motion(x, v, way + step.h * (before + halfKick));
    uint touched = corrections[i].w;
    for (uint plane = 0u; plane < (hasColliders ? 0u : planeCount); ++plane) {
#ifdef FORCES
        const vec3 free = motion.v;
#endif
        if (!projectOntoPlane(planes[plane], contactOffsets[i], step.h, motion)) continue;
        touched |= 1u << plane;
#ifdef FORCES
        addPlaneForce(planes[plane], plane, i, (motion.v - free) / velocities[i].w, motion.x);
#endif
    }
    way += motion.x - x;
    v = motion.v;
#endif
    // Even at rest v holds the half-kick h g / 2. Damping it as if it were motion would take weight off the body.
    v = mix(halfKick, v, step.velocityFactor);
#ifdef HAS_PLANES
    for (uint plane = 0u; plane < planeCount; ++plane) {
        if ((touched & 1u << plane) == 0u) continue;
        const vec3 change = rebound(planes[plane], step.restSpeed, before, v);
        v += change;
#ifdef FORCES
        addPlaneForce(planes[plane], plane, i, change / velocities[i].w, motion.x);
#endif
    }
#endif
    return way;
}
