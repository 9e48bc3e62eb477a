#version 460
// Ends a step: writes the public positions and velocities from the solver's state. Where that is no longer finite
// anywhere, the whole step is undone instead: the solver's state is made from the public one, which is the last finite.
// What put a NaN there once (a fault, a host) then harms nobody; a motion that diverges does so again and is reported again.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) buffer Positions { vec4 positions[]; };   // `split`: x + thetaH v
layout(std430, binding = 1) buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std430, binding = 2) readonly buffer Status { StatusWords status; };
layout(std140, binding = 3) uniform Step { StepParams step; };
layout(std430, binding = 4) buffer PublicPositions { vec4 publicPositions[]; };   // w = inverse mass
layout(std430, binding = 5) buffer PublicVelocities { vec4 publicVelocities[]; };
#ifdef HAS_SLOTS
layout(std430, binding = 6) readonly buffer Slots { uint slots[]; }; // of the state, where each particle is
#define SLOT(i) slots[i]
#else
#define SLOT(i) i
#endif
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const uint slot = SLOT(i);
    if (status.nonFinite == 0u) {
        const vec4 velocity = velocities[slot];
        publicPositions[i] = vec4(positions[slot].xyz - step.thetaH * velocity.xyz, velocity.w);
        publicVelocities[i] = velocity;
    } else {
        const vec4 velocity = publicVelocities[i];
        velocities[slot] = velocity;
        positions[slot].xyz = publicPositions[i].xyz + step.thetaH * velocity.xyz;
    }
}
