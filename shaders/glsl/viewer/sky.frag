#version 460
// The backdrop.
#extension GL_GOOGLE_include_directive : require
#include "viewer/light.glsl"

layout(location = 0) in vec2 clip;
layout(location = 0) out vec4 shown;

void main() {
    const vec3 ray = frame.rayForward.xyz + clip.x * frame.rayRight.xyz + clip.y * frame.rayUp.xyz;
    shown = finish(skyColor(normalize(ray)), gl_FragCoord.xy);
}
