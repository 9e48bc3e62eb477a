#version 460
// Checks list validity: whether a particle is, or was during this substep, farther from its expected position than
// the slack, and whether contacts may lie on paths of fast particles. plan_grid decides what follows.
#extension GL_GOOGLE_include_directive : require
#define MAY_RUN_LISTED
#include "common/kernel.glsl"
#include "collision/hash_grid.glsl"

#include "common/fetched.glsl"
FETCHED_VEC4(0, Positions, positionAt)
FETCHED_VEC4(1, Detected, detectedAt)   // positions when lists were made; w: body
FETCHED_VEC4(2, Velocities, velocityAt) // that led to these positions [m/s]; w = inverse mass
#define POSITION(i) positionAt(i)
#define DETECTED(i) detectedAt(i)
#define VELOCITY(i) velocityAt(i)
layout(std430, binding = 3) buffer Bounds { GridBounds bounds; };
layout(std430, binding = 4) readonly buffer Radii { float radii[]; };
layout(std430, binding = 5) writeonly buffer Fast { uint fast[]; };
layout(std140, binding = 6) uniform Step { StepParams step; };
layout(push_constant) uniform Push { GridPush push; };
#define FRAMES_BINDING 7
#define WAYS_BINDING 8
#define HEADING(i) vec4(0.0)
#include "collision/list_check.glsl"

void main() {
    const uint i = itemIndex(push.count);
    checkLists(i, POSITION(i).xyz, VELOCITY(i).xyz);
}
