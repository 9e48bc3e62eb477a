#version 460
// Gives placed particles the previous positions that they would have had in their new place: a pose is no motion. Those
// of an undone step stay.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/remainder.glsl"

layout(std430, binding = 0) readonly buffer Bodies { uint bodies[]; }; // by particle
layout(std430, binding = 1) readonly buffer Placed { uint placed[]; }; // by body: its pose + 1, or 0
layout(std430, binding = 2) readonly buffer Requests { MotionRequest requests[]; };
layout(std430, binding = 3) readonly buffer Frames { MotionFrame frames[]; };
layout(std430, binding = 4) readonly buffer Status { StatusWords status; };
layout(std430, binding = 5) buffer Previous { vec4 previous[]; };
layout(std430, binding = 6) readonly buffer Positions { vec4 positions[]; }; // public [m]
layout(push_constant) uniform Push { MotionPush push; };
#include "motions/pose.glsl"

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count || bodies[i] >= push.bodies || placed[bodies[i]] == 0u || !isFinished(status)) return;
    const uint k = placed[bodies[i]] - 1u; // a spawned body was nowhere: it has no motion
    previous[i].xyz = requests[k].kind == MOTION_POSE ? placedAt(k, previous[i].xyz).rounded : positions[i].xyz;
}
