#version 460
// Hides fragments in the pieces of a sheet's skin.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "cutting/debris.glsl"
layout(std430, binding = 6) readonly buffer State { SheetState state; };
layout(std430, binding = 7) readonly buffer SheetVertices { SheetVertex sheetVertices[]; };
layout(push_constant) uniform Push { SheetSkinPush push; };

void main() {
    const uint count = min(push.vertexRoom, state.vertices), i = itemIndex(count);
    if (i < count) hide(push.firstVertex + i, sheetVertices[i].a);
}
