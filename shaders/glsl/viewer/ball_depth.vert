#version 460
// Draws balls into the two maps, as depth.vert does skins.
#extension GL_GOOGLE_include_directive : require
#include "common/pieces.h"
#include "viewer/frame.glsl"

layout(constant_id = 3) const bool isPlan = false;
layout(location = 0) in vec4 corner;
layout(location = 1) in vec4 center;
layout(location = 2) in float radius;
layout(location = 4) in uint piece;
#ifdef SECTION
layout(location = 0) out vec3 worldPosition;
#endif

void main() {
#ifndef SECTION
    vec3 worldPosition;
#endif
    worldPosition = center.xyz + (piece == REMOVED_PIECE ? 0.0 : radius) * corner.xyz;
    gl_Position = (isPlan ? frame.planFromWorld : frame.shadowFromWorld) * vec4(worldPosition, 1.0);
}
