#version 460
// Skins into the two maps: what the key light sees, or what the floor sees looking up.
#extension GL_GOOGLE_include_directive : require
#include "viewer/frame.glsl"

layout(constant_id = 3) const bool isPlan = false;
layout(location = 0) in vec4 position;

void main() {
    gl_Position = (isPlan ? frame.planFromWorld : frame.shadowFromWorld) * vec4(position.xyz, 1.0);
}
