#version 460
// Contacts with faces, last pass: a particle is moved by all of its contacts at once, x_i += w_i sum beta_ic l_c n_c, as a
// point and as a corner. Momentum is exact to rounding, for impulses are the same bits wherever they are read.
// EDGES: as an end of edges, whose impulses are summed up already. ENDS_SUBSTEP: no other contacts follow; boundary planes
// come last and one after another. REBOUND: what velocities get of impulses [kg m/s] after all contacts of a substep.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "remainder.glsl"
#ifdef EDGES
layout(std430, binding = 0) readonly buffer Corners { uint corners[]; };   // first of each particle; then 2 x edge + end
layout(std430, binding = 1) readonly buffer Impulses { vec4 impulses[]; }; // on each end of all edges [kg m]
layout(push_constant) uniform Push { FacePush push; };
#define STATE_BINDING 2
#else
#include "face_shares.glsl"
layout(std430, binding = 6) readonly buffer Impulses { vec4 impulses[]; };   // [kg m]
#define STATE_BINDING 7
#endif
#ifdef REBOUND
layout(std430, binding = STATE_BINDING) buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std430, binding = STATE_BINDING + 1) buffer State { vec4 state[]; };       // x + thetaH v
layout(std140, binding = STATE_BINDING + 2) uniform Step { StepParams step; };
#else
layout(std430, binding = STATE_BINDING) readonly buffer Velocities { vec4 velocities[]; };   // w = inverse mass [1/kg]
layout(std430, binding = STATE_BINDING + 1) readonly buffer Predicted { vec4 predicted[]; }; // remainder.glsl; w: passed on
layout(std430, binding = STATE_BINDING + 2) writeonly buffer NextPositions { vec4 nextPositions[]; };
layout(std430, binding = STATE_BINDING + 3) writeonly buffer NextVelocities { vec4 nextVelocities[]; };
layout(std140, binding = STATE_BINDING + 4) uniform Step { StepParams step; };
#endif
#ifdef HAS_PLANES
#include "planes.glsl"
layout(std430, binding = STATE_BINDING + 5) readonly buffer Planes { PlaneCollider planes[]; };
layout(std430, binding = STATE_BINDING + 6) readonly buffer ContactOffsets { float contactOffsets[]; };
layout(std430, binding = STATE_BINDING + 7) readonly buffer Before { vec4 before[]; }; // velocities before the substep
#endif

#include "face_impulses.glsl"

#ifdef REBOUND
void main() {
    const uint i = itemIndex(push.count);
    const vec3 change = velocities[i].w * impulseOn(i);
    velocities[i].xyz += change;
    state[i].xyz += step.thetaH * change;
}
#else
void main() {
    const uint i = itemIndex(push.count);
    const vec4 self = predicted[i], velocity = velocities[i];
    const float w = velocity.w, h = step.h;
    const vec3 correction = w * impulseOn(i);
    vec3 x = self.xyz + correction, way = correction, v = velocity.xyz + correction / h;
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
        way = motion.displacement - h * velocity.xyz;
        v = motion.v;
    }
#endif
#ifdef ENDS_SUBSTEP
    x += step.thetaH * v;
    way += step.thetaH * v;
#endif
    if (hasRemainders) {
        const uint r = remainderOf(predicted.length(), i);
        const Sum sum = exactSum(self.xyz, predicted[r].xyz + way);
        x = sum.rounded;
        nextPositions[r] = vec4(sum.remainder, 0.0);
    }
    nextPositions[i] = vec4(x, self.w);
    nextVelocities[i] = vec4(v, w);
}
#endif
