#version 460
// Checks list validity for faces and edges: whether a particle is, or was at the start of the substep, farther from
// its expected position than the slack; these contacts cover the whole path of a substep. plan_grid decides what
// follows.
#extension GL_GOOGLE_include_directive : require
#define VISITS_SLOTS
#include "common/kernel.glsl"
#include "common/math.glsl"

#include "common/fetched.glsl"
FETCHED_VEC4(0, Positions, positionAt)
FETCHED_VEC4(1, Velocities, velocityAt)
FETCHED_VEC4(2, Detected, detectedAt)
#define POSITION(i) positionAt(i)
#define VELOCITY(i) velocityAt(i)
#define DETECTED(i) detectedAt(i)
layout(std430, binding = 3) buffer Bounds { GridBounds bounds; };
layout(std140, binding = 4) uniform Step { StepParams step; };
layout(push_constant) uniform Push { GridPush push; };
#define FRAMES_BINDING 5
FETCHED_VEC4(6, Headings, headingAt)
layout(constant_id = 1) const bool hasHeadings = false;
#define HEADING(i) (hasHeadings ? headingAt(i) : vec4(0.0))
#include "collision/strays.glsl"

void main() {
    const uint i = itemIndex(push.count);
    if (i == ~0u) return;
    Stray stray;
    if (hasStrayed(i, POSITION(i).xyz, VELOCITY(i).xyz, stray)) atomicMax(bounds.moved, floatBitsToUint(clamp(stray.farthest, 1e-30, 1e30)));
}
