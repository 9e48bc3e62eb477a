#version 460
// Ends a step for solver state other than positions and velocities: saves it while the state is finite, else restores
// it, as publish_state does for the state.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) buffer Memory { vec4 memory[]; };
layout(std430, binding = 1) buffer Saved { vec4 saved[]; };
layout(std430, binding = 2) readonly buffer Status { StatusWords status; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    if (isFinished(status)) saved[i] = memory[i];
    else memory[i] = saved[i];
}
