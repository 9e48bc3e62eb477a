#version 460
// Mixed skins, third pass: a whole triangle is drawn unless its parts replace it; whole triangles next to parts are
// drawn too, and their parts with them.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Wholes { WholeTriangle wholes[]; };
layout(std430, binding = 1) readonly buffer Marks { uint marks[]; };
layout(std430, binding = 2) readonly buffer Hung { HungVertex hung[]; };
layout(std430, binding = 3) buffer States { uint states[]; };
layout(std430, binding = 4) writeonly buffer MixedTriangles { uint mixedTriangles[]; };
layout(std430, binding = 5) writeonly buffer Shown { uint shown[]; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const WholeTriangle whole = wholes[i];
    const bool isParted = states[i] == WHOLE_PARTED;
    const bool isBeside = marks[whole.vertices[0]] + marks[whole.vertices[1]] + marks[whole.vertices[2]] > 0u;
    if (!isParted) states[i] = isBeside ? WHOLE_MIXED : WHOLE_ALONE;
    for (uint n = 0u; n < 3u; ++n) {
        const uint corner = hung[whole.vertices[n]].vertex;
        mixedTriangles[3u * whole.mixed + n] = isParted ? 0u : corner;
        if (isParted || isBeside) shown[corner] = VERTEX_PLACED | VERTEX_SHOWN;
    }
}
