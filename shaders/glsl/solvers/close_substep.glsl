// Part of advance_substep: ends the substep of a particle after the sweeps.

layout(constant_id = 11) const bool hasColliders = false; // with colliders, project_onto_planes handles the planes before them

// Turns the end of a sweep into the velocity after the substep, and returns the displacement from p to the position
// after it. `remainder` is the part of the corrections that the substep began with.
vec3 close(uint i, vec3 halfKick, vec3 p, vec3 remainder, inout vec3 v) {
    vec3 way = uintBitsToFloat(corrections[i].xyz);
    const vec3 before = v - 2.0 * halfKick;
    v += (way - remainder) / step.h;
    const vec3 x = p + way;
    Motion motion = Motion(x, v, way + step.h * (before + halfKick));
    uint touched = corrections[i].w;
    for (uint plane = 0u; plane < (hasColliders ? 0u : planeCount); ++plane) {
        const vec3 free = motion.v;
        if (!projectOntoPlane(planes[plane], contactOffsets[i], step.h, motion)) continue;
        touched |= 1u << plane;
        addPlaneForce(planes[plane], plane, i, (motion.v - free) / velocities[i].w, motion.x);
    }
    if (planeCount > 0u) {
        way += motion.x - x;
        v = motion.v;
    }
    // Even at rest v holds the half-kick h g / 2. Damping it like motion would reduce the weight of the body.
    v = mix(halfKick, v, step.velocityFactor);
    for (uint plane = 0u; plane < planeCount; ++plane) {
        if ((touched & 1u << plane) == 0u) continue;
        const vec3 change = rebound(planes[plane], step.restSpeed, before, v);
        v += change;
        addPlaneForce(planes[plane], plane, i, change / velocities[i].w, motion.x);
    }
    return way;
}
