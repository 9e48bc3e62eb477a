#version 460
// Marks the islands that awake particles have touched in this substep, before contacts are counted, so that no impact
// treats them as static.
#extension GL_GOOGLE_include_directive : require
#define RUNS_LISTED
#include "common/kernel.glsl"
#include "common/contacts.glsl"
#include "sleep/sleep.glsl"

layout(std430, binding = 0) readonly buffer Weights { float weights[]; };      // inverse mass of awake particles [1/kg]
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) readonly buffer Predicted { vec4 predicted[]; };   // [m]
layout(std430, binding = 3) readonly buffer Islands { uint islands[]; };
layout(std430, binding = 4) buffer Marks { uint marks[]; };
layout(std430, binding = 5) buffer State { SleepState state; };
layout(std430, binding = 6) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 7) readonly buffer Lists { uvec2 lists[]; };
layout(std140, binding = 8) uniform Step { StepParams step; };
layout(push_constant) uniform Push { SleepPush push; };

// True if two particles touch at the end of the substep, or on their paths: also where none is fast, so that a
// particle elsewhere that is fast wakes nobody.
bool meets(vec3 d, vec3 v, float reach) {
    return touches(d, reach) || nearestSquared(d, step.h * v) < reach * reach;
}

void main() {
    const uint i = itemIndex(push.count);
    if (weights[i] == 0.0 || velocities[i].w == 0.0) return;
    const vec3 x = predicted[i].xyz;
    const uvec2 list = lists[i];
    for (uint slot = list.x; slot < list.x + list.y; ++slot) {
        const ContactCandidate candidate = contacts[slot];
        const uint j = candidate.other;
        if (!isAsleep(weights[j], velocities[j]) || !meets(x - predicted[j].xyz, velocities[i].xyz, candidate.reach)) continue;
        atomicOr(marks[islands[j]], 1u);
        atomicOr(state.touched, 1u);
    }
}
