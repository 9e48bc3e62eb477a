#version 460
// Separations of sheets, second pass: ends the ways of particles, measured against that of their sheet, where
// separation.glsl limits them. So no face passes another of the same sheet, however hard they are pressed. Velocities stay:
// momentum is exact, and contacts take the approach away. All other particles stay unchanged to the bit.
#extension GL_GOOGLE_include_directive : require
#define RUNS_LISTED
#include "common/kernel.glsl"
#include "common/remainder.glsl"

layout(std430, binding = 0) readonly buffer Predicted { vec4 predicted[]; };
layout(std430, binding = 1) readonly buffer PredictedVelocities { vec4 predictedVelocities[]; }; // that led to those positions [m/s]
layout(std430, binding = 2) buffer Positions { vec4 positions[]; };   // x + thetaH v (remainder.glsl)
layout(std430, binding = 3) readonly buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std430, binding = 4) buffer Parts { uint parts[]; };           // by slot: bits of the part of its way that it may go
layout(std140, binding = 5) uniform Step { StepParams step; };
#define SPEEDS_BINDING 6
layout(push_constant) uniform Push { FacePush push; };
#include "collision/body_speeds.glsl"
#define TOUCHED_LIST TOUCHED_PARTICLES
#include "collision/touched.h"
#include "collision/touched.glsl"

void main() {
    const uint i = touchedSlots == 0u ? itemIndex(push.count) : touchedItem();
    if (i == ~0u) return;
    const float part = uintBitsToFloat(parts[i]);
    if (part == 1.0) return;
    parts[i] = floatBitsToUint(1.0);
    const vec4 velocity = velocities[i];
    if (velocity.w == 0.0) return;
    const vec3 start = predicted[i].xyz - step.h * predictedVelocities[i].xyz, x = positions[i].xyz - step.thetaH * velocity.xyz;
    const vec3 change = (part - 1.0) * (x - start - step.h * sheetSpeedOf(i));
    if (!hasRemainders) {
        positions[i].xyz += change;
        return;
    }
    const uint r = remainderOf(positions.length(), i);
    const Sum sum = exactSum(positions[i].xyz, change + positions[r].xyz);
    positions[i].xyz = sum.rounded;
    positions[r].xyz = sum.remainder;
}
