#version 460
// Skin vertices as the simulation leaves them (SkinVertex of layout.h).
#extension GL_GOOGLE_include_directive : require
#include "viewer/frame.glsl"

layout(location = 0) in vec4 position;
layout(location = 1) in vec4 normal;
layout(location = 0) out vec3 worldPosition;
layout(location = 1) out vec3 worldNormal;

void main() {
    worldPosition = position.xyz;
    worldNormal = normal.xyz;
    gl_Position = frame.clipFromWorld * vec4(position.xyz, 1.0);
}
