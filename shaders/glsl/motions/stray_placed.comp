#version 460
// Makes contact lists forget where placed particles were: lists are made again in the first substep.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Bodies { uint bodies[]; };   // by slot
layout(std430, binding = 1) readonly buffer Placed { uint placed[]; };   // by body: its pose + 1, or 0
layout(std430, binding = 2) buffer Detected { vec4 detected[]; };        // by slot: position when lists were made; w: body
layout(push_constant) uniform Push { MotionPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count || bodies[i] >= push.bodies || placed[bodies[i]] == 0u) return;
    detected[i].xyz = vec3(1e18);
}
