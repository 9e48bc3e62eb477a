#version 460
// Sets the w of positions to that of the scene: `split` keeps tau there, a time that follows from stiffness, masses
// and substep length; a state taken over from a simulation with another material, or other substeps, has another w.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Initial { vec4 initial[]; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i < push.count) positions[i].w = initial[i].w;
}
