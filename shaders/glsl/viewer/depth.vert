#version 460
// Draws skins and colliders into one of the two maps: the view of the key light, or the view from the floor upwards.
#extension GL_GOOGLE_include_directive : require
#include "viewer/frame.glsl"

layout(constant_id = 3) const bool isPlan = false;
layout(push_constant) uniform Push { SkinPush push; };
layout(location = 0) in vec4 position;
#ifdef SECTION
layout(location = 0) out vec3 worldPosition;
#endif

void main() {
#ifndef SECTION
    vec3 worldPosition;
#endif
    worldPosition = rotated(push.rotation, push.scale.x * position.xyz) + push.position.xyz;
    gl_Position = (isPlan ? frame.planFromWorld : frame.shadowFromWorld) * vec4(worldPosition, 1.0);
    gl_Position.z = max(gl_Position.z, 0.0); // geometry lifted out of the volume still casts a shadow; below the floor it counts as touching it
}
