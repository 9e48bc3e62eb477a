// The end of a substep of `split` with contacts: boundary planes, and the stored state. Requires the names predicted,
// nextPositions, nextVelocities and BEFORE of a kernel, PLANE_BINDING, and forces.glsl before it.
#include "rigid/planes.glsl"
layout(std140, binding = PLANE_BINDING) uniform Planes { PlaneCollider planes[MOST_PLANES]; };
layout(std430, binding = PLANE_BINDING + 1) readonly buffer ContactOffsets { float contactOffsets[]; };
#ifdef RECEIVES
vec3 fromPlanes = vec3(0.0), fromRebounds = vec3(0.0); // changes of v by planes without and with restitution
uint lastPlane = 0u;                                   // that touched, of the former
vec3 lastArm = vec3(0.0);
#endif

// Ends the substep of particle i, which contacts have moved from `found` by `correction` and given the velocity v;
// `velocity` is the one before contacts, w its inverse mass; `last` is the fourth component of its position, stored
// unchanged. Returns the velocity after the planes.
vec3 finish(uint i, vec3 found, float last, vec4 velocity, vec3 correction, vec3 v) {
    const float w = velocity.w, h = step.h;
    vec3 x = found + correction, way = correction;
    if (w > 0.0 && planeCount > 0u) {
        Motion motion = Motion(x, v, h * velocity.xyz + correction);
        const float offset = contactOffsets[i];
        uint touched = 0u;
        for (uint p = 0u; p < planeCount; ++p) {
            const vec3 before = motion.v;
            if (projectOntoPlane(planes[p], offset, h, motion)) touched |= 1u << p;
            if ((touched & 1u << p) != 0u) addPlaneForce(planes[p], p, i, (motion.v - before) / w, motion.x);
#ifdef RECEIVES
            const bool isFixed = (touched & 1u << p) != 0u && planes[p].restitution <= 0.0;
            fromPlanes += isFixed ? motion.v - before : vec3(0.0);
            fromRebounds += isFixed ? vec3(0.0) : motion.v - before;
            if (keepsForces && isFixed) {
                lastPlane = p;
                lastArm = planeArm(planes[p], motion.x);
            }
#endif
        }
#ifdef HAS_REBOUND
        for (uint p = 0u; p < (HAS_REBOUND ? planeCount : 0u); ++p) {
            if ((touched & 1u << p) == 0u) continue;
            const vec3 change = rebound(planes[p], step.restSpeed, BEFORE(i), motion.v);
            motion.v += change;
            addPlaneForce(planes[p], p, i, change / w, motion.x);
        }
#endif
        x = motion.x;
        way = motion.displacement - h * velocity.xyz;
        v = motion.v;
    }
    if (hasRemainders) {
        const uint r = remainderOf(predicted.length(), i);
        const Sum sum = exactSum(found, predicted[r].xyz + way + step.thetaH * v);
        x = sum.rounded;
        nextPositions[r] = vec4(sum.remainder, 0.0);
    } else {
        x += step.thetaH * v;
    }
    nextPositions[i] = vec4(x, last);
    nextVelocities[i] = vec4(v, w);
    return v;
}
