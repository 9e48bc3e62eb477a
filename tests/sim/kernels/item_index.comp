#version 460
// Writes the item index of every invocation.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) writeonly buffer Items { uint items[]; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    if (gl_GlobalInvocationID.x < push.count) items[gl_GlobalInvocationID.x] = itemIndex(push.count);
}
