#version 460
// Contact marks in the color of their kind (Okabe and Ito 2008): walls, particles, faces.
#extension GL_GOOGLE_include_directive : require
#include "viewer/light.glsl"
#include "viewer/section.glsl"

layout(location = 0) in vec3 worldNormal;
layout(location = 1) in float kind;
layout(location = 2) in vec3 worldPosition;
layout(location = 0) out vec4 shown;

void main() {
    keepBehindSection(worldPosition);
    const vec3 color = kind < 0.5 ? vec3(0.79, 0.35, 0.0) : kind < 1.5 ? vec3(0.0, 0.17, 0.45) : vec3(0.6, 0.19, 0.38);
    const float light = 0.75 + 0.25 * dot(normalize(worldNormal), frame.toLight.xyz);
    shown = encoded(light * color, gl_FragCoord.xy);
}
