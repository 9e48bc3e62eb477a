#version 460
// Gives positions the w that the scene asks for: `split` keeps a time there that follows from stiffness, masses and the length
// of a substep, and that a state of another material, or of other substeps, has brought along.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Initial { vec4 initial[]; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i < push.count) positions[i].w = initial[i].w;
}
