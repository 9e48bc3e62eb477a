#version 460
// Takes what the links of a substep have pulled at particles that never move from their velocities, where the gathers of `split` have stored it
// (split.glsl), and gives those back: 0, which driven particles replace. What is held by a particle feels the opposite.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(push_constant) uniform Push { CountPush push; };
#define FORCES
#define FORCES_BINDING 1
#include "forces.glsl"

void main() {
    const uint i = itemIndex(push.count);
    const vec4 velocity = velocities[i];
    if (velocity.w != 0.0) return;
    addHoldForce(i, -velocity.xyz);
    velocities[i] = vec4(0.0);
}
