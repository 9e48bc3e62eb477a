#version 460
// Runs after the check that a step is finished: decides whether rest is judged, and stores the values that the next
// step is compared with. One group.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) buffer State { SleepState state; };
layout(std430, binding = 1) buffer Status { StatusWords status; };
layout(std430, binding = 2) writeonly buffer Waking { DispatchArguments waking[]; };
layout(std140, binding = 3) uniform Step { StepParams step; };
layout(std430, binding = 4) readonly buffer Anchors { vec4 anchors[]; };
layout(std430, binding = 5) writeonly buffer SeenAnchors { vec4 seenAnchors[]; };
layout(std430, binding = 6) readonly buffer Ways { ColliderPose ways[]; };
layout(std430, binding = 7) writeonly buffer SeenPoses { ColliderPose seenPoses[]; };
layout(std430, binding = 8) readonly buffer Arguments { DispatchArguments arguments[]; };
layout(push_constant) uniform Push { SleepPush push; };

void main() {
    const uint lane = gl_LocalInvocationID.x;
    const bool stays = isFinished(status);
    for (uint a = lane; stays && a < push.attachments; a += GROUP_SIZE) seenAnchors[a] = anchors[2u * a + 1u];
    for (uint c = lane; stays && c < push.colliders; c += GROUP_SIZE) seenPoses[c] = ways[2u * c + 1u];
    if (lane > 0u) return;
    const uint one = arguments[0].groupsX, judges = stays ? one : 0u; // one group, if anything runs
    waking[SLEEP_RESTING] = DispatchArguments(judges * push.groups, 1u, 1u, 0u);
    waking[SLEEP_CLOSING_ONE] = DispatchArguments(one, 1u, 1u, 0u);
    if (one > 0u) state.sleeping = status.sleeping = 0u; // counted again
    if (!stays) return;
    state.gravity = step.gravity;
    state.h = step.h;
    state.wakes = 0u;
}
