#version 460
// Vertices of skins and of cuts, or particles, a little nearer than what they are edges of.
#extension GL_GOOGLE_include_directive : require
#include "viewer/frame.glsl"

layout(location = 0) in vec4 position;
layout(location = 0) out vec3 worldPosition;

void main() {
    worldPosition = position.xyz;
    gl_Position = frame.clipFromWorld * vec4(mix(position.xyz, frame.eye.xyz, 0.001), 1.0);
}
