#version 460
// Ends a substep of `split` after contacts with faces and between edges, where particles do not touch each other:
// projects onto boundary planes, one after another, and stores the state.
#extension GL_GOOGLE_include_directive : require
#define VISITS_SLOTS
#include "common/kernel.glsl"
#include "common/remainder.glsl"

layout(std430, binding = 0) readonly buffer Predicted { vec4 predicted[]; };
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; }; // that led to these positions; w = inverse mass
layout(std140, binding = 2) uniform Step { StepParams step; };
layout(std430, binding = 3) writeonly buffer NextPositions { vec4 nextPositions[]; };
layout(std430, binding = 4) writeonly buffer NextVelocities { vec4 nextVelocities[]; };
layout(std430, binding = 5) readonly buffer Before { vec4 before[]; }; // velocities before the substep
#define BEFORE(i) before[i].xyz
#define HAS_REBOUND true
#define PLANE_BINDING 6
layout(push_constant) uniform Push { CountPush push; };
#include "forces/forces.glsl"
#include "collision/finish_substep.glsl"

void main() {
    const uint i = itemIndex(push.count);
    if (i == ~0u) return;
    const vec4 x = predicted[i], velocity = velocities[i];
    finish(i, x.xyz, x.w, velocity, vec3(0.0), velocity.xyz);
}
