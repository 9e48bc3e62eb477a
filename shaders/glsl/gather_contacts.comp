#version 460
// Contacts, second pass, which ends a substep of `split`: a particle is moved out of all others that it touches, at once
// and as a part of itself 1 / (number of its contacts) each (mass-split Jacobi, contacts: 7, variant B). For a pair,
//
//   l = (reach - |d|) / (c_i w_i + c_j w_j),   x_i += w_i l n   and the opposite for j: momentum is exact to rounding.
//
// Friction pulls back the way `t` that the two have slid on each other since they touched, by at most friction x l; t is
// what remains of it. Without that memory a pile creeps for ever. Boundary planes come last and one after another.
// v changes by the corrections / h, not by a difference of positions, which is coarser. HAS_MEMORY: something is remembered
// of each candidate, the way t, and what is left of an overlap that it had when the scene was loaded. HAS_SURFACES: pairs
// differ in friction.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "contacts.glsl"

#ifdef TEXELS
layout(binding = 0) uniform samplerBuffer touching;
layout(binding = 1) uniform usamplerBuffer contacts;
layout(binding = 2) uniform samplerBuffer velocities;
#define TOUCHING(i) texelFetch(touching, int(i))
#define CONTACT(i) texelFetch(contacts, int(i)).xy
#define VELOCITY(i) texelFetch(velocities, int(i))
#else
layout(std430, binding = 0) readonly buffer Touching { vec4 touching[]; };  // x, contacts x inverse mass
layout(std430, binding = 1) readonly buffer Contacts { uvec2 contacts[]; }; // ContactCandidate, in one load
layout(std430, binding = 2) readonly buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
#define TOUCHING(i) touching[i]
#define CONTACT(i) contacts[i]
#define VELOCITY(i) velocities[i]
#endif
layout(std430, binding = 3) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 4) readonly buffer Predicted { vec4 predicted[]; };         // w: passed on
layout(std430, binding = 5) writeonly buffer NextPositions { vec4 nextPositions[]; }; // x + thetaH v
layout(std430, binding = 6) writeonly buffer NextVelocities { vec4 nextVelocities[]; };
layout(std140, binding = 7) uniform Step { StepParams step; };
#ifdef HAS_MEMORY
layout(std430, binding = 8) buffer Slips { vec4 slips[]; }; // of each candidate: t [m]; what is left of an overlap [m]
layout(constant_id = 3) const bool hasFriction = true;
layout(constant_id = 4) const bool hasRecovery = false;
#ifdef HAS_SURFACES
layout(std430, binding = 9) readonly buffer Surfaces { uint surfaces[]; }; // of each particle
layout(std430, binding = 10) readonly buffer Pairs { SurfacePair pairs[]; };
#define FRICTION(i, j) pairs[surfaces[i] * push.surfaces + surfaces[j]].friction
#define PLANE_BINDING 11
#else
#define FRICTION(i, j) push.friction
#define PLANE_BINDING 9
#endif
#else
#define PLANE_BINDING 8
#endif
#ifdef HAS_PLANES
#include "planes.glsl"
layout(std430, binding = PLANE_BINDING) readonly buffer Planes { PlaneCollider planes[]; };
layout(std430, binding = PLANE_BINDING + 1) readonly buffer ContactOffsets { float contactOffsets[]; };
#ifdef HAS_REBOUND
layout(std430, binding = PLANE_BINDING + 2) readonly buffer Before { vec4 before[]; }; // velocities before the substep
#endif
#endif
layout(push_constant) uniform Push { ContactPush push; };

#ifdef HAS_MEMORY
// What friction takes back of a pair's tangential way, x w = share of the pair, at most `most`; the rest is remembered.
vec3 held(uint slot, vec3 n, vec3 relative, float most, float share, float offset) {
    vec3 slip = slips[slot].xyz + relative;
    slip -= dot(slip, n) * n;
    const float force = length(slip) * share;
    if (force > most) slip *= most / force;
    slips[slot] = vec4(slip, offset);
    return share * slip;
}
#endif

// The impulse on particle i from the candidate in `slot` [kg m].
vec3 impulseFrom(uint i, uint slot, vec4 self, vec3 velocity) {
    const uvec2 candidate = CONTACT(slot);
    const vec4 other = TOUCHING(candidate.x);
    const vec3 d = self.xyz - other.xyz;
    float reach = uintBitsToFloat(candidate.y);
#ifdef HAS_MEMORY
    const float offset = hasRecovery ? slips[slot].w : 0.0;
    reach -= offset;
#endif
    if (!touches(d, reach)) {
#ifdef HAS_MEMORY
        slips[slot] = vec4(0.0, 0.0, 0.0, offset);
#endif
        return vec3(0.0);
    }
    const Direction direction = directionOf(d, i, candidate.x);
    const float share = 1.0 / max(self.w + other.w, 1e-30); // two that never move: nothing times w = 0
    const float lambda = (reach - direction.distance) * share;
    vec3 impulse = lambda * direction.n;
#ifdef HAS_MEMORY
    if (hasFriction) {
        const vec3 relative = step.h * (velocity - VELOCITY(candidate.x).xyz);
        impulse -= held(slot, direction.n, relative, FRICTION(i, candidate.x) * lambda, share, offset);
    }
#endif
    return impulse;
}

void main() {
    const uint i = itemIndex(push.count), n = counts[i];
    const vec4 self = TOUCHING(i), velocity = VELOCITY(i);
    const float w = velocity.w, h = step.h;
    vec3 sum = vec3(0.0);
    for (uint s = 0u; s < n; ++s) sum += impulseFrom(i, s * push.row + i, self, velocity.xyz);
    const vec3 correction = w * sum;
    vec3 x = self.xyz + correction, v = velocity.xyz + correction / h;
#ifdef HAS_PLANES
    if (w > 0.0) {
        Motion motion = Motion(x, v, h * velocity.xyz + correction);
        const float offset = contactOffsets[i];
        uint touched = 0u;
        for (uint p = 0u; p < planeCount; ++p) {
            if (projectOntoPlane(planes[p], offset, h, motion)) touched |= 1u << p;
        }
#ifdef HAS_REBOUND
        for (uint p = 0u; p < planeCount; ++p) {
            if ((touched & 1u << p) != 0u) motion.v += rebound(planes[p], step.restSpeed, before[i].xyz, motion.v);
        }
#endif
        x = motion.x;
        v = motion.v;
    }
#endif
    nextPositions[i] = vec4(x + step.thetaH * v, predicted[i].w);
    nextVelocities[i] = vec4(v, w);
}
