#version 460
// Links, flat in the color of their class.
#extension GL_GOOGLE_include_directive : require
#include "viewer/light.glsl"

layout(push_constant) uniform Push { SkinPush push; };
layout(location = 0) out vec4 shown;

void main() {
    shown = encoded(push.color.rgb, gl_FragCoord.xy);
}
