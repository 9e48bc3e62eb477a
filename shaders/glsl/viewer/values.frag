#version 460
// Surfaces in the color of a map, by the strain or speed of their particles. Grey: unknown.
#extension GL_GOOGLE_include_directive : require
#include "viewer/tissue.glsl"
#include "viewer/section.glsl"

layout(push_constant) uniform Push { SkinPush push; };
layout(location = 0) in vec3 worldPosition;
layout(location = 1) in vec3 worldNormal;
layout(location = 2) in float value; // below 0: unknown
layout(location = 0) out vec4 shown;

void main() {
    keepBehindSection(worldPosition);
    shown = matt(worldPosition, worldNormal, mapColor(value, push.color.x));
}
