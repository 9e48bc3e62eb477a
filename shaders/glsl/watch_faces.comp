#version 460
// Finds out whether a particle is, or was when the substep began, farther from where it was when lists were made than they
// bear: contacts with faces look at the whole way of a substep. plan_grid decides what follows.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) readonly buffer Detected { vec4 detected[]; };
layout(std430, binding = 3) buffer Bounds { GridBounds bounds; };
layout(std140, binding = 4) uniform Step { StepParams step; };
layout(push_constant) uniform Push { GridPush push; };

void main() {
    const uint i = itemIndex(push.count);
    const vec3 way = positions[i].xyz - detected[i].xyz, before = way - step.h * velocities[i].xyz;
    const float squared = max(dot(way, way), dot(before, before));
    if (!(squared <= push.slack * push.slack)) // what is no number has gone far
        atomicMax(bounds.moved, floatBitsToUint(min(sqrt(squared), 1e30)));
}
