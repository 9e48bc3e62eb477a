#version 460
// Links, unlit in the color of their class.
#extension GL_GOOGLE_include_directive : require
#include "viewer/light.glsl"
#include "viewer/section.glsl"

layout(push_constant) uniform Push { SkinPush push; };
layout(location = 0) in vec3 worldPosition;
layout(location = 0) out vec4 shown;

void main() {
    keepBehindSection(worldPosition);
    shown = encoded(push.color.rgb, gl_FragCoord.xy);
}
