#version 460
// Ends a step: writes the public positions and velocities from the solver's state, unless that is no longer finite:
// then the last finite ones stay.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };   // `split`: x + thetaH v
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std430, binding = 2) readonly buffer Status { StatusWords status; };
layout(std140, binding = 3) uniform Step { StepParams step; };
layout(std430, binding = 4) writeonly buffer PublicPositions { vec4 publicPositions[]; };   // w = inverse mass
layout(std430, binding = 5) writeonly buffer PublicVelocities { vec4 publicVelocities[]; };
#ifdef HAS_SLOTS
layout(std430, binding = 6) readonly buffer Slots { uint slots[]; }; // of the state, where each particle is
#define SLOT(i) slots[i]
#else
#define SLOT(i) i
#endif
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count || status.nonFinite != 0u) return;
    const vec4 velocity = velocities[SLOT(i)];
    publicPositions[i] = vec4(positions[SLOT(i)].xyz - step.thetaH * velocity.xyz, velocity.w);
    publicVelocities[i] = velocity;
}
