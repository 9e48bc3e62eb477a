#version 460
// Group counts of the passes over several lists.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 1) writeonly buffer Arguments { DispatchArguments arguments[]; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i < push.count) arguments[i] = DispatchArguments((counts[i] + GROUP_SIZE - 1u) / GROUP_SIZE, 1u, 1u, 0u);
}
