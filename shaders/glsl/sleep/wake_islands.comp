#version 460
// Wakes the particles of marked islands: restores their inverse masses, and makes their groups run, also for driven
// particles. Their resting time starts again at the end of the step.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "sleep/sleep.glsl"

layout(std430, binding = 0) readonly buffer Weights { float weights[]; }; // inverse mass of awake particles [1/kg]
layout(std430, binding = 1) buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) readonly buffer Islands { uint islands[]; };
layout(std430, binding = 3) readonly buffer Marks { uint marks[]; };
layout(std430, binding = 4) buffer Groups { uint groups[]; }; // one per work group of particles: bit 0 = any awake
layout(push_constant) uniform Push { SleepPush push; };

void main() {
    const uint i = itemIndex(push.count);
    const bool isDriven = weights[i] == SLEEP_DRIVEN;
    if (!isDriven && !isAsleep(weights[i], velocities[i]) || marks[islands[i]] == 0u) return;
    if (!isDriven) velocities[i].w = weights[i];
    atomicOr(groups[i / GROUP_SIZE], 1u);
}
