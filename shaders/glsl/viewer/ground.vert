#version 460
// A square at the height of the scene's floor: wide enough to end in haze, or as wide as the floor map. It is pushed
// away from the eye by a thousandth, so that cloth on the floor does not flicker.
#extension GL_GOOGLE_include_directive : require
#include "viewer/frame.glsl"

layout(push_constant) uniform Push { SkinPush push; }; // color.xyz: x and z of the centre, half the width [m]
layout(location = 0) out vec3 worldPosition;

void main() {
    const vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 2.0 - 1.0;
    const vec2 place = push.color.xy + push.color.z * corner;
    worldPosition = vec3(place.x, frame.ground.x, place.y);
    gl_Position = frame.clipFromWorld * vec4(mix(frame.eye.xyz, worldPosition, 1.001), 1.0);
}
