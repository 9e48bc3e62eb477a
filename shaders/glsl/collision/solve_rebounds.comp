#version 460
// Restitution between particles, second pass, after contacts have removed the approach of a substep: gives the two
// particles of a rebounding contact the speed at which they must separate. A particle takes part with a share 1 /
// (number of its bounces):
//
//   l = (speed - n . (v_i - v_j)) / (b_i w_i + b_j w_j) >= 0,   v_i += w_i l n   and the opposite for j.
#extension GL_GOOGLE_include_directive : require
#define MAY_RUN_LISTED
#include "common/kernel.glsl"
#include "common/contacts.glsl"
#include "collision/bounces.glsl"
#include "common/fetched.glsl"
FETCHED_VEC4(BOUNCE_BINDING, Velocities, velocityAt) // w = inverse mass [1/kg]
#define VELOCITY(i) velocityAt(i)
layout(std430, binding = BOUNCE_BINDING + 1) readonly buffer Bouncing { float bouncing[]; }; // bounces x inverse mass
layout(std430, binding = BOUNCE_BINDING + 2) buffer State { vec4 state[]; };                 // x + thetaH v
layout(std430, binding = BOUNCE_BINDING + 3) writeonly buffer NextVelocities { vec4 nextVelocities[]; };
#include "forces/forces.glsl"

void main() {
    const uint i = itemIndex(push.count);
    const float own = bouncing[i];
    const uvec2 list = lists[i];
    const uint words = keepsForces || own > 0.0 ? wordsOf(list) : 0u; // static particles do not rebound, but receive forces
    const Self self = selfOf(i);
    const vec4 velocity = VELOCITY(i);
    vec3 sum = vec3(0.0);
    for (uint word = 0u; word < words; ++word) {
        for (uint at = hits[hitWord(push.count, i, list, word)].x; at != 0u; at &= at - 1u) {
            const uint slot = list.x + 32u * word + findLSB(at);
            const Bounce bounce = bounceFrom(i, slot, self);
            const float both = own + bouncing[CONTACT(slot).x];
            if (bounce.speed == 0.0 || both == 0.0) continue; // two static particles exchange nothing
            const float missing = bounce.speed - dot(bounce.n, velocity.xyz - VELOCITY(CONTACT(slot).x).xyz);
            sum += max(0.0, missing) / both * bounce.n;
        }
    }
    addContactForce(i, sum);
    const vec3 change = velocity.w * sum;
    nextVelocities[i] = vec4(velocity.xyz + change, velocity.w);
    state[i].xyz += step.thetaH * change;
}
