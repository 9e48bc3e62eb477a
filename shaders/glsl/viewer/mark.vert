#version 460
// A contact mark: a ball at the contact point, and a needle along its normal.
#extension GL_GOOGLE_include_directive : require
#include "viewer/frame.glsl"

layout(push_constant) uniform Push { SkinPush push; }; // position.w: radius of the ball [m]
layout(location = 0) in vec4 corner;                   // hand_mesh.cpp
layout(location = 1) in vec4 point;
layout(location = 2) in vec4 normal;
layout(location = 0) out vec3 worldNormal;
layout(location = 1) out float kind;
layout(location = 2) out vec3 worldPosition;

void main() {
    const float size = push.position.w;
    const vec3 across = normalize(cross(normal.xyz, abs(normal.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
    const bool isBall = corner.w > 0.5;
    worldNormal = isBall ? corner.xyz : corner.x * across + corner.y * cross(normal.xyz, across);
    const vec3 onNeedle = 7.0 * corner.z * normal.xyz + 0.45 * (1.0 - corner.z) * worldNormal;
    kind = normal.w;
    worldPosition = point.xyz + size * (isBall ? corner.xyz : onNeedle);
    gl_Position = frame.clipFromWorld * vec4(worldPosition, 1.0);
}
