#version 460
// Writes only depth, of the part behind the section plane.
#extension GL_GOOGLE_include_directive : require
#include "viewer/frame.glsl"

layout(location = 0) in vec3 worldPosition;

void main() {
    if (dot(frame.section.xyz, worldPosition) > frame.section.w) discard;
}
