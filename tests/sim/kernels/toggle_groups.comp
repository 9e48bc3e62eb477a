#version 460
// Switches an indirect dispatch between no group and the groups for all items.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) buffer Arguments { DispatchArguments arguments[]; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    if (gl_GlobalInvocationID.x > 0u) return;
    const uint all = (push.count - 1u) / GROUP_SIZE + 1u;
    arguments[1] = DispatchArguments(all - arguments[1].groupsX, 1u, 1u, 0u);
}
