#version 460
// Gives particles that were not in the scene before a state of `split` as of the last step: a velocity half a substep
// behind their position, and the position that this solver stores.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Origins { uint origins[]; }; // by slot: the slot before, or NO_ELEMENT
layout(std430, binding = 1) buffer Positions { vec4 positions[]; };
layout(std430, binding = 2) buffer Velocities { vec4 velocities[]; };
layout(push_constant) uniform Push { ArrivalPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count || origins[i] != NO_ELEMENT || velocities[i].w == 0.0) return;
    const vec3 v = velocities[i].xyz - push.halfKick.xyz;
    velocities[i].xyz = v;
    positions[i].xyz += push.thetaH * v;
}
