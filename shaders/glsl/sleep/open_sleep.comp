#version 460
// Begins a step of a scene that sleeps: detects reasons to wake: a change of gravity or of the step length, a request
// by the host, a moved anchor or collider, a cut (wake_cut). One group.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) buffer State { SleepState state; };
layout(std430, binding = 1) buffer Status { StatusWords status; };
layout(std430, binding = 2) writeonly buffer Waking { DispatchArguments waking[]; };
layout(std140, binding = 3) uniform Step { StepParams step; };
layout(std430, binding = 4) readonly buffer Anchors { vec4 anchors[]; };         // one per attachment: start and end of the step [m]
layout(std430, binding = 5) readonly buffer SeenAnchors { vec4 seenAnchors[]; }; // at the end of the last step
layout(std430, binding = 6) readonly buffer Ways { ColliderPose ways[]; };       // one per collider: start and end of the step
layout(std430, binding = 7) readonly buffer SeenPoses { ColliderPose seenPoses[]; };
layout(push_constant) uniform Push { SleepPush push; };

shared uint changes;

void main() {
    const uint lane = gl_LocalInvocationID.x;
    if (lane == 0u) changes = 0u;
    barrier();
    bool isChanged = false, isDriven = false;
    for (uint a = lane; a < push.attachments; a += GROUP_SIZE)
        isChanged = isChanged || anchors[2u * a + 1u].xyz != seenAnchors[a].xyz;
    for (uint c = lane; c < push.colliders; c += GROUP_SIZE) {
        if (ways[2u * c + 1u] == seenPoses[c]) continue;
        isChanged = true;
        isDriven = isDriven || c >= push.colliders - push.driven;
    }
    if (isChanged) atomicOr(changes, isDriven ? 3u : 1u);
    barrier();
    if (lane > 0u) return;
    status.frame = step.frame; // no other kernel writes it while all particles sleep
    status.sleeping = state.sleeping;
    state.wakes |= step.wakes & WAKES_ALL; // until a step finishes
    const bool wakesAll = state.wakes != 0u || state.gravity != step.gravity || state.h != step.h;
    state.wakesAll = wakesAll ? 1u : 0u;
    const bool wakes = state.sleeping > 0u && (wakesAll || changes != 0u || state.touched != 0u);
    const uint one = wakes || (changes & 2u) != 0u || (step.wakes & WAKES_LISTS) != 0u ? 1u : 0u;
    state.touched = 0u;
    waking[SLEEP_OPENING] = DispatchArguments(one * push.groups, 1u, 1u, 0u);
    waking[SLEEP_OPENING_ONE] = DispatchArguments(one, 1u, 1u, 0u);
    waking[SLEEP_WAKING] = waking[SLEEP_WAKING_ONE] = DispatchArguments(0u, 1u, 1u, 0u);
}
