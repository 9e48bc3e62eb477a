#version 460
// Edges of cells, unlit.
#extension GL_GOOGLE_include_directive : require
#include "viewer/light.glsl"
#include "viewer/section.glsl"

layout(location = 0) in vec3 worldPosition;
layout(location = 1) flat in vec3 color;
layout(location = 0) out vec4 shown;

void main() {
    keepBehindSection(worldPosition);
    shown = encoded(color, gl_FragCoord.xy);
}
