#version 460
// Saves position and velocity of particles at the start of a substep, for scenes with restitution (solve_colliders).
#extension GL_GOOGLE_include_directive : require
#define MAY_RUN_LISTED
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; }; // x + thetaH v
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) writeonly buffer Before { vec4 before[]; };
layout(std140, binding = 3) uniform Step { StepParams step; };
layout(push_constant) uniform Push { SubstepPush push; };

void main() {
    const uint i = itemIndex(push.count);
    const vec4 v = velocities[i];
    before[2u * i] = vec4(positions[i].xyz - (push.isFirst != 0u ? step.thetaHPrevious : step.thetaH) * v.xyz, 0.0);
    before[2u * i + 1u] = v;
}
