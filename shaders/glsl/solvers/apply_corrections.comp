#version 460
// The particle pass of `jacobi`: x += weight * sum of the particle's correction slots, in slot order, and v += the
// same / h. Carrying v as a state avoids the cancellation of (x - x_previous) / h.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Incidences { Incidence incidences[]; };
layout(std430, binding = 1) readonly buffer Slots { uint slots[]; };
layout(std430, binding = 2) readonly buffer Corrections { vec4 corrections[]; };
layout(std430, binding = 3) buffer Positions { vec4 positions[]; };
layout(std430, binding = 4) buffer Velocities { vec4 velocities[]; };
layout(std140, binding = 5) uniform Step { StepParams step; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const Incidence incidence = incidences[i];
    vec3 sum = vec3(0.0);
    for (uint s = 0u; s < incidence.count; ++s) {
        sum += corrections[slots[incidence.first + s]].xyz;
    }
    const vec3 dx = incidence.weight * sum;
    positions[i].xyz += dx;
    velocities[i].xyz += dx / step.h;
}
