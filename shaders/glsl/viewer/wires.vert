#version 460
// Vertices of skins and of cuts, or particles, slightly nearer to the eye than the surfaces below.
#extension GL_GOOGLE_include_directive : require
#include "viewer/frame.glsl"

layout(location = 0) in vec4 position;
layout(location = 0) out vec3 worldPosition;

void main() {
    worldPosition = position.xyz;
    gl_Position = frame.clipFromWorld * vec4(mix(position.xyz, frame.eye.xyz, 0.001), 1.0);
}
