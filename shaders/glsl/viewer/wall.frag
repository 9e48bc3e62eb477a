#version 460
// The side of a wall, of one color. Only those that face the eye are drawn: they stand behind the bodies.
#extension GL_GOOGLE_include_directive : require
#include "viewer/light.glsl"

layout(push_constant) uniform Push { SkinPush push; }; // color.w: opacity
layout(location = 0) in vec3 worldPosition;
layout(location = 0) out vec4 shown;

void main() {
    const float height = (worldPosition.y - frame.ground.x) / frame.stage.w;
    const float opacity = push.color.w * mix(1.0, 0.7, clamp(height, 0.0, 1.0)); // denser at the floor
    shown = vec4(encoded(push.color.rgb, gl_FragCoord.xy).rgb, opacity);
}
