#version 460
// A cell of a hash grid as the edges of a cube, slightly smaller than the cell, so that neighbours stay apart.
#extension GL_GOOGLE_include_directive : require
#include "viewer/frame.glsl"

layout(push_constant) uniform Push { SkinPush push; }; // color.x: the count that has the last color of the map
layout(location = 0) in vec4 low;                      // corner and edge [m]
layout(location = 1) in vec4 held;                     // number of particles in the cell; of other cells in its slot
layout(location = 0) out vec3 worldPosition;
layout(location = 1) flat out vec3 color;

const vec3 sharedColor = vec3(0.79, 0.0, 0.21); // panel_look.cpp

void main() {
    const uint edge = gl_VertexIndex / 2, axis = edge / 4;
    const vec2 beside = vec2(edge & 1u, edge >> 1 & 1u);
    const float along = float(gl_VertexIndex & 1);
    const vec3 corner = axis == 0 ? vec3(along, beside) : axis == 1 ? vec3(beside.x, along, beside.y) : vec3(beside, along);
    worldPosition = low.xyz + low.w * mix(vec3(0.03), vec3(0.97), corner);
    color = held.y > 0.0 ? sharedColor : mapColor(held.x, push.color.x);
    gl_Position = frame.clipFromWorld * vec4(worldPosition, 1.0);
}
