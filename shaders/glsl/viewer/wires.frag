#version 460
// Edges of triangles, over their surface.
#extension GL_GOOGLE_include_directive : require
#include "viewer/frame.glsl"
#include "viewer/section.glsl"

layout(location = 0) in vec3 worldPosition;
layout(location = 0) out vec4 shown;

void main() {
    keepBehindSection(worldPosition);
    shown = vec4(0.02, 0.025, 0.03, 0.4);
}
