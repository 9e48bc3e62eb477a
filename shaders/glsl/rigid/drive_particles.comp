#version 460
// Moves driven particles along the paths of their bodies: at the end of a substep each is at its position on the
// path, with the velocity of that displacement, which contacts and links use.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "rigid/pose.glsl"

layout(std430, binding = 0) readonly buffer Driven { DrivenParticle driven[]; };
layout(std430, binding = 1) readonly buffer Poses { ColliderPose poses[]; }; // at the ends of all substeps
layout(std430, binding = 2) buffer Positions { vec4 positions[]; };          // x + thetaHStored v
layout(std430, binding = 3) writeonly buffer Velocities { vec4 velocities[]; };
layout(std140, binding = 4) uniform Step { StepParams step; };
layout(push_constant) uniform Push { DrivenPush push; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const DrivenParticle one = driven[item];
    const ColliderPose from = poses[push.before + one.pose], to = poses[push.after + one.pose];
    const vec3 turned = rotated(to.rotation, one.place.xyz);
    const vec3 v = (to.position.xyz - from.position.xyz + turned - rotated(from.rotation, one.place.xyz)) / step.h;
    positions[one.particle].xyz = to.position.xyz + turned + step.thetaHStored * v;
    velocities[one.particle] = vec4(v, 0.0);
}
