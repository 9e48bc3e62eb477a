#version 460
// Split skins, second pass: marks the corners of whole triangles beside a cut.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Wholes { WholeTriangle wholes[]; };
layout(std430, binding = 1) readonly buffer States { uint states[]; };
layout(std430, binding = 2) writeonly buffer Marks { uint marks[]; }; // one per bound vertex
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count || states[i] != WHOLE_PARTED) return;
    marks[wholes[i].vertices[0]] = marks[wholes[i].vertices[1]] = marks[wholes[i].vertices[2]] = 1u;
}
