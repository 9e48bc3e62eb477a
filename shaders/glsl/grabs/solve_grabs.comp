#version 460
// Pulls held particles towards the target of their grab at the end of a substep, each by itself: a spring and a
// damper to the moving point, implicit and solved exactly, so that any gains are stable [Baraff and Witkin 1998, for
// one particle], and limited. Gains and limit are those of the grab times the mass of the held component, divided
// among the held particles. Serves every solver: thetaH is 0 except for `split`; the substep of `gauss_seidel` is
// still open (solve_attachments.comp).
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Requests { GrabRequest requests[]; };
layout(std430, binding = 1) readonly buffer States { GrabState states[]; };
layout(std430, binding = 2) readonly buffer Bodies { GrabBody bodies[]; };
layout(std430, binding = 3) readonly buffer Grips { Grip grips[]; };
layout(std430, binding = 4) readonly buffer Held { uint held[]; };
layout(std430, binding = 5) readonly buffer Pulling { DispatchArguments pulling; };
#ifdef OPEN
layout(std430, binding = 6) readonly buffer Positions { vec4 positions[]; }; // predicted; w = inverse mass [1/kg]
layout(std430, binding = 7) readonly buffer Velocities { vec4 velocities[]; }; // velocities of the prediction
#else
layout(std430, binding = 6) buffer Positions { vec4 positions[]; };   // x + thetaH v
layout(std430, binding = 7) buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
#endif
layout(std140, binding = 8) uniform Step { StepParams step; };
#ifdef OPEN
layout(std430, binding = 9) buffer Corrections { vec4 corrections[]; }; // ParticleCorrection
#endif
layout(push_constant) uniform Push { GrabPush push; };
#include "forces/forces.glsl"

// Impulse of the grab on a particle at x with velocity v [kg m/s].
vec3 impulseOf(uint p, vec3 x, vec3 v, float w) {
    const Grip grip = grips[p];
    const uint k = (grip.held >> GRAB_SHARE_BITS) - 1u;
    const GrabRequest request = requests[k];
    const float share = float(grip.held & (1u << GRAB_SHARE_BITS) - 1u) / float(states[k].total);
    const float mass = share * bodies[p].mass, h = step.h;
    const vec3 way = mix(request.from.xyz, request.to.xyz, push.fraction) + grip.offset.xyz - x;
    const vec3 moved = v - push.lateKick * h * step.gravity.xyz; // the velocity of x, 0 at rest
    const vec3 force = mass * (request.stiffness * way + request.damping * (request.velocity.xyz - moved));
    const vec3 impulse = h * force / (1.0 + w * mass * (request.stiffness * h + request.damping) * h);
    const float most = mass * request.maxAcceleration * h, size = length(impulse);
    return size > most ? impulse * (most / size) : impulse;
}

void main() {
    const uint i = itemIndex(pulling.unused0);
    if (i >= pulling.unused0) return;
    const uint p = held[i], slot = bodies[p].slot;
#ifdef OPEN
    const vec3 correction = corrections[slot].xyz, v = velocities[slot].xyz + correction / step.h;
    const float w = velocities[slot].w;
    const vec3 x = positions[slot].xyz + correction, impulse = impulseOf(p, x, v, w);
    corrections[slot].xyz = correction + step.h * w * impulse;
#else
    const vec4 velocity = velocities[slot];
    const vec3 x = positions[slot].xyz - step.thetaH * velocity.xyz;
    const float w = velocity.w;
    const vec3 impulse = impulseOf(p, x, velocity.xyz, w), kick = w * impulse;
    velocities[slot].xyz = velocity.xyz + kick;
    positions[slot].xyz = x + step.h * kick + step.thetaH * (velocity.xyz + kick);
#endif
    const uint k = (grips[p].held >> GRAB_SHARE_BITS) - 1u;
    if (w > 0.0) addRowForce(k, slot, impulse, x - mix(requests[k].from.xyz, requests[k].to.xyz, push.fraction));
}
