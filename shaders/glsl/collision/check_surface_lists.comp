#version 460
// Checks list validity for faces and edges: whether a particle is, or was at the start of the substep, farther from
// its expected position than the slack; these contacts cover the whole path of a substep. plan_grid decides what
// follows.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/math.glsl"

#ifdef TEXELS
layout(binding = 0) uniform samplerBuffer positions;
layout(binding = 1) uniform samplerBuffer velocities;
layout(binding = 2) uniform samplerBuffer detected;
#define POSITION(i) texelFetch(positions, int(i))
#define VELOCITY(i) texelFetch(velocities, int(i))
#define DETECTED(i) texelFetch(detected, int(i))
#else
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) readonly buffer Detected { vec4 detected[]; };
#define POSITION(i) positions[i]
#define VELOCITY(i) velocities[i]
#define DETECTED(i) detected[i]
#endif
layout(std430, binding = 3) buffer Bounds { GridBounds bounds; };
layout(std140, binding = 4) uniform Step { StepParams step; };
layout(push_constant) uniform Push { GridPush push; };
#define FRAMES_BINDING 5
#include "collision/strays.glsl"

void main() {
    const uint i = itemIndex(push.count);
    if (i == ~0u) return;
    float farthest;
    if (hasStrayed(i, POSITION(i).xyz, VELOCITY(i).xyz, farthest)) atomicMax(bounds.moved, floatBitsToUint(clamp(farthest, 1e-30, 1e30)));
}
