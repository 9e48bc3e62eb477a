#version 460
// The outside of bodies.
#extension GL_GOOGLE_include_directive : require
#include "viewer/tissue.glsl"
#include "viewer/section.glsl"
#include "viewer/shown.glsl"

layout(push_constant) uniform Push { SkinPush push; };
layout(location = 0) in vec3 worldPosition;
layout(location = 1) in vec3 worldNormal;
layout(location = 2) in float asleep; // 1 = paler

void main() {
    keepBehindSection(worldPosition);
    const vec3 albedo = mix(push.color.rgb, vec3(0.62, 0.66, 0.72), 0.55 * asleep);
    show(worldPosition, worldNormal, tissue(albedo, push.color.w));
}
