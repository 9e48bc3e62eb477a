#version 460
// Runs after wake_touched: writes the group counts of the passes that wake islands. One item.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) buffer State { SleepState state; };
layout(std430, binding = 1) writeonly buffer Waking { DispatchArguments waking[]; };
layout(push_constant) uniform Push { SleepPush push; };

void main() {
    if (gl_GlobalInvocationID.x > 0u) return;
    const uint one = state.touched;
    waking[SLEEP_WAKING] = DispatchArguments(one * push.groups, 1u, 1u, 0u);
    waking[SLEEP_WAKING_ONE] = DispatchArguments(one, 1u, 1u, 0u);
    state.touched = 0u;
}
