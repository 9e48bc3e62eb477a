#version 460
// Panels: a small picture from the sheet, filtered between four texels.
#extension GL_GOOGLE_include_directive : require
#include "viewer/panel.h"

layout(constant_id = 0) const uint isLinear = 1; // the target encodes linear colors
layout(std430, binding = 1) readonly buffer Sheet { uint sheet[]; }; // sRGB, rows from the top
layout(push_constant) uniform Push { PanelPush push; };
layout(location = 0) in vec2 texel; // texel of the sheet, in the units of push.atlas
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 shown;

#include "viewer/srgb.glsl"

void main() {
    const float top = floor(texel.y / push.pictureHeight) * push.pictureHeight;
    const vec2 last = vec2(push.atlas.x, top + push.pictureHeight) - 1.0;
    const vec2 place = clamp(texel - 0.5, vec2(0.0, top), last);
    const vec2 low = floor(place), high = min(low + 1.0, last), part = place - low;
    const uint width = uint(push.atlas.x);
    const uvec2 from = uvec2(low), to = uvec2(high);
    const vec4 upper = mix(unpackUnorm4x8(sheet[from.y * width + from.x]), unpackUnorm4x8(sheet[from.y * width + to.x]), part.x);
    const vec4 lower = mix(unpackUnorm4x8(sheet[to.y * width + from.x]), unpackUnorm4x8(sheet[to.y * width + to.x]), part.x);
    const vec3 mixed = mix(upper, lower, part.y).rgb;
    shown = vec4(isLinear != 0 ? decoded(mixed) : mixed, color.a);
}
