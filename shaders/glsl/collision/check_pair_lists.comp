#version 460
// Checks list validity: whether a particle is, or was during this substep, farther from its expected position than
// the slack, and whether contacts may lie on paths of fast particles. plan_grid decides what follows.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "collision/hash_grid.glsl"

#ifdef TEXELS
layout(binding = 0) uniform samplerBuffer positions;
layout(binding = 1) uniform samplerBuffer detected;
layout(binding = 2) uniform samplerBuffer velocities;
#define POSITION(i) texelFetch(positions, int(i))
#define DETECTED(i) texelFetch(detected, int(i))
#define VELOCITY(i) texelFetch(velocities, int(i))
#else
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Detected { vec4 detected[]; }; // positions when lists were made; w: body
layout(std430, binding = 2) readonly buffer Velocities { vec4 velocities[]; }; // that led to these positions [m/s]
#define POSITION(i) positions[i]
#define DETECTED(i) detected[i]
#define VELOCITY(i) velocities[i]
#endif
layout(std430, binding = 3) buffer Bounds { GridBounds bounds; };
layout(std430, binding = 4) readonly buffer Radii { float radii[]; };
layout(std430, binding = 5) writeonly buffer Fast { uint fast[]; };
layout(std140, binding = 6) uniform Step { StepParams step; };
layout(push_constant) uniform Push { GridPush push; };
#define FRAMES_BINDING 7
#include "collision/list_check.glsl"

void main() {
    const uint i = itemIndex(push.count);
    checkLists(i, POSITION(i).xyz, VELOCITY(i).xyz, push.quiet, push.most);
}
