#version 460
// Contacts with faces, last pass: a particle is moved by all of its contacts at once, x_i += w_i sum beta_ic l_c n_c, as a
// point and as a corner. Momentum is exact to rounding, for impulses are the same bits wherever they are read.
// ENDS_SUBSTEP: no contacts between particles follow; boundary planes come last and one after another.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "face_shares.glsl"
layout(std430, binding = 6) readonly buffer Impulses { vec4 impulses[]; };   // [kg m]
layout(std430, binding = 7) readonly buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std430, binding = 8) readonly buffer Predicted { vec4 predicted[]; };  // w: passed on
layout(std430, binding = 9) writeonly buffer NextPositions { vec4 nextPositions[]; };
layout(std430, binding = 10) writeonly buffer NextVelocities { vec4 nextVelocities[]; };
layout(std140, binding = 11) uniform Step { StepParams step; };
#ifdef HAS_PLANES
#include "planes.glsl"
layout(std430, binding = 12) readonly buffer Planes { PlaneCollider planes[]; };
layout(std430, binding = 13) readonly buffer ContactOffsets { float contactOffsets[]; };
layout(std430, binding = 14) readonly buffer Before { vec4 before[]; }; // velocities before the substep
#endif

vec3 impulseOn(uint i) {
    const uint n = counts[i];
    vec3 sum = vec3(0.0);
    for (uint s = 0u; s < n; ++s)
        if (directions[s * push.row + i].w > 0.0) sum += impulses[s * push.row + i].xyz;
    for (uint k = corners[i]; k < corners[i + 1u]; ++k) {
        const uint face = corners[k] / 4u, corner = corners[k] % 4u, points = linkCounts[face];
        for (uint s = 0u; s < points; ++s) {
            const uint element = links[s * push.faceRow + face];
            if (directions[element].w > 0.0) sum -= weights[element][corner] * impulses[element].xyz;
        }
    }
    return sum;
}

void main() {
    const uint i = itemIndex(push.count);
    const vec4 self = predicted[i], velocity = velocities[i];
    const float w = velocity.w, h = step.h;
    const vec3 correction = w * impulseOn(i);
    vec3 x = self.xyz + correction, v = velocity.xyz + correction / h;
#ifdef HAS_PLANES
    if (w > 0.0) {
        Motion motion = Motion(x, v, h * velocity.xyz + correction);
        uint touched = 0u;
        for (uint p = 0u; p < planeCount; ++p) {
            if (projectOntoPlane(planes[p], contactOffsets[i], h, motion)) touched |= 1u << p;
        }
        for (uint p = 0u; p < planeCount; ++p) {
            if ((touched & 1u << p) != 0u) motion.v += rebound(planes[p], step.restSpeed, before[i].xyz, motion.v);
        }
        x = motion.x;
        v = motion.v;
    }
#endif
#ifdef ENDS_SUBSTEP
    nextPositions[i] = vec4(x + step.thetaH * v, self.w);
#else
    nextPositions[i] = vec4(x, self.w);
#endif
    nextVelocities[i] = vec4(v, w);
}
