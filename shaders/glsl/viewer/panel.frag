#version 460
// Panels: the color times the atlas's coverage of this pixel. Glyphs are drawn pixel on pixel, so nothing is
// filtered; solid areas, which are most pixels, read nothing.
#extension GL_GOOGLE_include_directive : require
#include "viewer/panel.h"

layout(std430, binding = 0) readonly buffer Atlas { uint coverage[]; }; // four texels a word, rows from the top
layout(push_constant) uniform Push { PanelPush push; };
layout(location = 0) in vec2 texel;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 shown;

void main() {
    shown = color;
    if (any(greaterThan(abs(texel - push.full), vec2(0.25)))) {
        const uvec2 at = uvec2(clamp(texel, vec2(0.0), push.atlas - 1.0));
        const uint index = at.y * uint(push.atlas.x) + at.x;
        shown.a *= float(bitfieldExtract(coverage[index >> 2], int(index & 3u) * 8, 8)) / 255.0;
    }
}
