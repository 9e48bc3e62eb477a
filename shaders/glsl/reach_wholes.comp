#version 460
// Mixed skins, fourth pass: whole triangles that are drawn alone and touch one of which parts are drawn. Normals there come from parts of both.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Wholes { WholeTriangle wholes[]; };
layout(std430, binding = 1) readonly buffer Hung { HungVertex hung[]; };
layout(std430, binding = 2) readonly buffer Shown { uint shown[]; };
layout(std430, binding = 3) buffer States { uint states[]; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count || states[i] != WHOLE_ALONE) return;
    bool touches = false;
    for (uint n = 0u; n < 3u; ++n) touches = touches || shown[hung[wholes[i].vertices[n]].vertex] == VERTEX_SHOWN;
    if (touches) states[i] = WHOLE_BESIDE;
}
