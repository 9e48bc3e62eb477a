#version 460
// Counts particles with a non-finite state. Uses integer atomics, and only for such particles.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) buffer Status { StatusWords status; };
layout(std140, binding = 3) uniform Step { StepParams step; };
#define SLOTS_BINDING 4
#include "compile/slots.glsl"

// False if all exponent bits are set: Inf or NaN. Tests bits, so that no compiler may assume the test away.
bool isFinite(vec3 a) {
    return all(notEqual(floatBitsToUint(a) & uvec3(0x7f800000u), uvec3(0x7f800000u)));
}

void main() {
    const uint i = itemIndex(push.count);
    if (i == 0u) status.frame = step.frame;
    if (i >= push.count) return;
    const uint slot = slotOf(i);
    if (isFinite(positions[slot].xyz) && isFinite(velocities[slot].xyz)) return;
    atomicAdd(status.nonFinite, 1u);
    atomicMax(status.invertedFirstBad, ~i);
}
