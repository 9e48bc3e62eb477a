#version 460
// Panels: transforms pixels of the picture to clip space, and sRGB colors to those that the target expects.
#extension GL_GOOGLE_include_directive : require
#include "viewer/panel.h"

layout(constant_id = 0) const uint isLinear = 1; // the target encodes linear colors
layout(push_constant) uniform Push { PanelPush push; };
layout(location = 0) in vec2 place;
layout(location = 1) in vec2 atlasPlace;
layout(location = 2) in vec4 tint;
layout(location = 0) out vec2 texel;
layout(location = 1) out vec4 color;

#include "viewer/srgb.glsl"

void main() {
    texel = atlasPlace * push.atlas;
    color = vec4(isLinear != 0 ? decoded(tint.rgb) : tint.rgb, tint.a);
    gl_Position = vec4(place * push.scale - 1.0, 0.0, 1.0);
}
