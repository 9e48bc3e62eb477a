#version 460
// Gives the particles of marked islands their masses back, and runs what is driven again. How long they rest is counted anew when the step ends.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "sleep.glsl"

layout(std430, binding = 0) readonly buffer Weights { float weights[]; }; // inverse mass of what is awake [1/kg]
layout(std430, binding = 1) buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) readonly buffer Islands { uint islands[]; };
layout(std430, binding = 3) readonly buffer Marks { uint marks[]; };
layout(std430, binding = 4) buffer Groups { uint groups[]; }; // of particles: bit 0 = somebody in it is awake
layout(push_constant) uniform Push { SleepPush push; };

void main() {
    const uint i = itemIndex(push.count);
    const bool isDriven = weights[i] == SLEEP_DRIVEN;
    if (!isDriven && !isAsleep(weights[i], velocities[i]) || marks[islands[i]] == 0u) return;
    if (!isDriven) velocities[i].w = weights[i];
    atomicOr(groups[i / GROUP_SIZE], 1u);
}
