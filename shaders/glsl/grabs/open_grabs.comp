#version 460
// Begins a step with grabs: compares the grabs set by the host with the present ones. If one begins or ends, all held
// particles are listed again. One group, one invocation a grab.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Requests { GrabRequest requests[]; };
layout(std430, binding = 1) buffer States { GrabState states[]; };
layout(std430, binding = 2) writeonly buffer Holding { DispatchArguments holding; };
layout(std430, binding = 3) buffer Pulling { DispatchArguments pulling; }; // unused0: number of held particles
layout(push_constant) uniform Push { GrabPush push; };

shared uint changes;

void main() {
    const uint lane = gl_LocalInvocationID.x;
    if (lane == 0u) changes = 0u;
    barrier();
    const bool isGrab = lane < push.grabs;
    const bool isNew = isGrab && requests[lane].serial != states[lane].serial;
    if (isNew) atomicOr(changes, 1u);
    barrier();
    const bool isChanged = changes != 0u;
    if (isGrab) {
        const uint total = isChanged ? 0u : states[lane].total; // summed again
        states[lane] = GrabState(requests[lane].serial, isNew ? 1u : 0u, total, 0u);
    }
    if (lane > 0u) return;
    holding = DispatchArguments(isChanged ? push.groups : 0u, 1u, 1u, 0u);
    if (isChanged) pulling = DispatchArguments(0u, 1u, 1u, 0u);
}
