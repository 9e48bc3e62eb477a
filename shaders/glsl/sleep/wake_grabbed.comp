#version 460
// Marks the islands of held particles, which wake at the start of a step (mark_waking.comp).
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "sleep/sleep.glsl"

layout(std430, binding = 0) readonly buffer Bodies { GrabBody bodies[]; };
layout(std430, binding = 1) readonly buffer Held { uint held[]; };
layout(std430, binding = 2) readonly buffer Pulling { DispatchArguments pulling; }; // arguments of the grabs
layout(std430, binding = 3) readonly buffer Weights { float weights[]; };
layout(std430, binding = 4) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 5) readonly buffer Islands { uint islands[]; };
layout(std430, binding = 6) buffer Marks { uint marks[]; };
layout(std430, binding = 7) buffer Waking { DispatchArguments waking[]; };
layout(push_constant) uniform Push { SleepPush push; };

void main() {
    const uint i = itemIndex(pulling.unused0);
    if (i >= pulling.unused0) return;
    const uint slot = bodies[held[i]].slot;
    if (bodies[held[i]].mass == 0.0) return; // a removed fragment
    if (!isAsleep(weights[slot], velocities[slot])) return;
    atomicOr(marks[islands[slot]], 1u);
    atomicMax(waking[SLEEP_OPENING].groupsX, push.groups);
    atomicMax(waking[SLEEP_OPENING_ONE].groupsX, 1u);
}
