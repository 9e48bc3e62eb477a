#version 460
// Hides fragments in skins: collapses the skin of each removed piece to a point.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "cutting/debris.glsl"
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i < push.count) hide(i, slots[i]);
}
