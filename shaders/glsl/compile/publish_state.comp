#version 460
// Ends a step: writes the public positions and velocities from the solver's state. If any value is not finite, or
// contacts did not fit, the whole step is undone instead: the solver's state is restored from the public one, which
// is the last finite one. A single NaN (from a fault or the host) then does no lasting harm; a motion that diverges
// does so again and is reported again.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/remainder.glsl"

layout(std430, binding = 0) buffer Positions { vec4 positions[]; };   // `split`: x + thetaH v
layout(std430, binding = 1) buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std430, binding = 2) readonly buffer Status { StatusWords status; };
layout(std140, binding = 3) uniform Step { StepParams step; };
layout(std430, binding = 4) buffer PublicPositions { vec4 publicPositions[]; }; // w = inverse mass
layout(std430, binding = 5) buffer PublicVelocities { vec4 publicVelocities[]; };
layout(constant_id = 2) const bool publishesVelocities = true;
#define SLOTS_BINDING 6
#include "compile/slots.glsl"

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const uint slot = slotOf(i);
    if (isFinished(status)) {
        const vec4 velocity = velocities[slot];
        publicPositions[i] = vec4(positions[slot].xyz - step.thetaH * velocity.xyz, velocity.w);
        if (publishesVelocities) publicVelocities[i] = velocity;
    } else {
        vec4 velocity = vec4(0, 0, 0, publicPositions[i].w); // velocities are not stored: the body stops
        if (publishesVelocities) velocity = publicVelocities[i];
        velocities[slot] = velocity;
        positions[slot].xyz = publicPositions[i].xyz + step.thetaH * velocity.xyz;
        if (hasRemainders) positions[remainderOf(positions.length(), slot)].xyz = vec3(0.0);
    }
}
