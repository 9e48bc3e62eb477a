#version 460
// Ends a step in which any particle was awake: marks the work groups that run in the next step, and counts sleeping
// particles. A group whose particles have all fallen asleep runs for two more steps: all buffers then hold the values
// of particles that never move, and lists are no longer rebuilt. After an undone step all groups run.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "sleep/sleep.glsl"

layout(std430, binding = 0) readonly buffer Weights { float weights[]; }; // inverse mass of awake particles [1/kg]
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) buffer Status { StatusWords status; };
layout(std430, binding = 3) buffer Groups { uint groups[]; }; // any awake; bit 0: now, bits 1 and 2: at the ends of the steps before
layout(std430, binding = 4) writeonly buffer Marks { uint marks[]; };
layout(std430, binding = 5) buffer State { SleepState state; };
layout(push_constant) uniform Push { SleepPush push; };

shared uint awake, asleep;

void main() {
    const uint i = itemIndex(push.count), lane = gl_LocalInvocationID.x;
    if (lane == 0u) awake = asleep = 0u;
    barrier();
    if (isAsleep(weights[i], velocities[i])) atomicAdd(asleep, 1u);
    else if (weights[i] > 0.0 || weights[i] == SLEEP_DRIVEN && velocities[i].xyz != vec3(0.0)) atomicOr(awake, 1u);
    marks[i] = 0u;
    barrier();
    if (lane > 0u) return;
    const uint before = groups[i / GROUP_SIZE];
    groups[i / GROUP_SIZE] = isFinished(status) ? (before << 1 & 6u) | awake : 7u;
    if (asleep == 0u) return;
    atomicAdd(state.sleeping, asleep);
    atomicAdd(status.sleeping, asleep);
}
