#version 460
// Surfaces in the color of a map: of what their particles have of strain or speed. Grey: nothing is known.
#extension GL_GOOGLE_include_directive : require
#include "viewer/tissue.glsl"

layout(push_constant) uniform Push { SkinPush push; };
layout(location = 0) in vec3 worldPosition;
layout(location = 1) in vec3 worldNormal;
layout(location = 2) in float value; // below 0: there is none
layout(location = 0) out vec4 shown;

void main() {
    const float place = clamp(value / max(push.color.x, 1e-30), 0.0, 1.0) * float(MAP_COLORS - 1);
    const int low = min(int(place), MAP_COLORS - 2);
    const vec3 color = mix(frame.mapColors[low].rgb, frame.mapColors[low + 1].rgb, place - float(low));
    shown = matt(worldPosition, worldNormal, value < 0.0 || push.color.x <= 0.0 ? vec3(0.32) : color);
}
