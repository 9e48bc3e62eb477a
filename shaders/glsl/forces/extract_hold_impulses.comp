#version 460
// Moves the impulses of links on static particles out of their velocities, where the gathers of `split` have stored
// them (split.glsl). The velocities become 0 again; drive_particles sets those of driven particles. The hold balances
// these impulses.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(push_constant) uniform Push { CountPush push; };
#include "forces/forces.glsl"

void main() {
    const uint i = itemIndex(push.count);
    const vec4 velocity = velocities[i];
    if (velocity.w != 0.0) return;
    addHoldForce(i, -velocity.xyz);
    velocities[i] = vec4(0.0);
}
