#version 460
// The surface of cuts as the simulation leaves it: the inside, and pieces of skins beside it.
#extension GL_GOOGLE_include_directive : require
#include "viewer/frame.glsl"

layout(location = 0) in vec4 position;
layout(location = 1) in vec4 normal;
layout(location = 2) in vec4 rest; // where the point is in the body as it was loaded [m]; w = index of its skin
layout(location = 0) out vec3 worldPosition;
layout(location = 1) out vec3 worldNormal;
layout(location = 2) out vec4 inBody;

void main() {
    worldPosition = position.xyz;
    worldNormal = normal.xyz;
    inBody = rest;
    gl_Position = frame.clipFromWorld * vec4(worldPosition, 1.0);
}
