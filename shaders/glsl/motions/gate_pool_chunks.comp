#version 460
// Lets a dispatch over listed chunks run only while a particle is awake. One item.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Awake { DispatchArguments awake[]; };
layout(std430, binding = 1) buffer Arguments { DispatchArguments arguments[]; }; // of the dispatch; and those of the list (list_pool_chunks)
layout(push_constant) uniform Push { PoolListPush push; };

void main() {
    if (gl_GlobalInvocationID.x > 0u) return;
    arguments[0] = arguments[1];
    if (awake[0].groupsX == 0u) arguments[0].groupsX = 0u;
}
