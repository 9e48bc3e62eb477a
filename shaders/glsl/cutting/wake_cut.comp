#version 460
// Marks the islands of sleeping bodies that lost links to the blade: they wake at the start of the step (open_sleep).
#extension GL_GOOGLE_include_directive : require
#include "common/cut.glsl"
#include "sleep/sleep.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer SavedLinks { uint savedLinks[]; };
layout(std430, binding = 2) readonly buffer Weights { float weights[]; }; // inverse mass of awake particles [1/kg]
layout(std430, binding = 3) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 4) readonly buffer Islands { uint islands[]; };
layout(std430, binding = 5) buffer Marks { uint marks[]; };
layout(std430, binding = 6) buffer State { SleepState state; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item;
    if (links[i] == savedLinks[i] || !isAsleep(weights[i], velocities[i])) return;
    atomicOr(marks[islands[i]], 1u);
    atomicOr(state.touched, 1u);
}
