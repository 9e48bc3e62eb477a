#version 460
// Initialises the state of a solver from the public state that another solver has left: particles that slept are
// awake.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/remainder.glsl"

layout(std430, binding = 0) buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg] of the scene
layout(std430, binding = 2) buffer PublicPositions { vec4 publicPositions[]; };
layout(std430, binding = 3) buffer PublicVelocities { vec4 publicVelocities[]; };
#define SLOTS_BINDING 4
#include "compile/slots.glsl"

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const uint slot = slotOf(i);
    positions[slot].xyz = publicPositions[i].xyz;
    if (hasRemainders) positions[remainderOf(positions.length(), slot)].xyz = vec3(0.0);
    velocities[slot].xyz = publicVelocities[i].xyz;
    publicPositions[i].w = velocities[slot].w;
    publicVelocities[i].w = velocities[slot].w;
}
