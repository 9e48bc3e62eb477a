#version 460
// The handle of a grab and its rope (hand_mesh.cpp): a ball at the target of the grab, and a rope from there to a
// point that moves with the particle of the instance, if that was not removed.
#extension GL_GOOGLE_include_directive : require
#include "common/pieces.h"
#include "viewer/frame.glsl"

layout(push_constant) uniform Push { SkinPush push; }; // position: of the ball, w: size; rotation.xyz: of the held point, w: radius of the ball over the size, below 0 for a pin
layout(location = 0) in vec4 corner;
layout(location = 1) in vec4 particle;
layout(location = 4) in uint piece;
layout(location = 0) out vec3 worldPosition;
layout(location = 1) out vec3 worldNormal;
layout(location = 2) out float asleep;

void main() {
    const bool isPin = push.rotation.w < 0.0, hasRope = !isPin && piece != REMOVED_PIECE; // a pin is at the held point
    const vec3 hand = push.position.xyz, held = !hasRope ? hand : particle.xyz + push.rotation.xyz;
    const vec3 way = hand - held;
    const vec3 along = !hasRope ? vec3(0.0, 1.0, 0.0) : way / max(length(way), 1e-20);
    const vec3 across = normalize(cross(along, abs(along.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
    const bool isBall = corner.w > 0.5;
    worldNormal = isBall ? corner.xyz : corner.x * across + corner.y * cross(along, across);
    worldPosition = isBall ? hand + abs(push.rotation.w) * push.position.w * corner.xyz : mix(held, hand, corner.z) + 0.3 * push.position.w * worldNormal;
    asleep = 0.0;
    gl_Position = frame.clipFromWorld * vec4(worldPosition, 1.0);
}
