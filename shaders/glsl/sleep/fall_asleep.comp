#version 460
// Puts every island to sleep that has rested for SLEEP_TIME.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/remainder.glsl"

layout(std430, binding = 0) readonly buffer Weights { float weights[]; }; // inverse mass of awake particles [1/kg]
layout(std430, binding = 1) buffer Positions { vec4 positions[]; };       // x + thetaH v
layout(std430, binding = 2) buffer Velocities { vec4 velocities[]; };
layout(std140, binding = 3) uniform Step { StepParams step; };
layout(std430, binding = 4) readonly buffer Islands { uint islands[]; };
layout(std430, binding = 5) readonly buffer Least { uint least[]; };
layout(std430, binding = 6) buffer Rests { vec4 rests[]; };
layout(constant_id = 14) const bool hasWays = false;
layout(std430, binding = 7) writeonly buffer Ways { float ways[]; }; // as in list_check.glsl
layout(push_constant) uniform Push { SleepPush push; };

void main() {
    const uint i = itemIndex(push.count);
    const vec4 velocity = velocities[i];
    if (weights[i] == 0.0 || velocity.w == 0.0) return;
    if (uintBitsToFloat(least[islands[i]]) < 0.9999 * SLEEP_TIME) return; // a sum of rounded steps
    positions[i].xyz -= step.thetaH * velocity.xyz;
    if (hasRemainders) positions[remainderOf(positions.length(), i)].xyz = vec3(0.0); // or it would move once more
    velocities[i] = vec4(0.0);
    rests[i].w = -1.0;
    if (hasWays) ways[i] = 0.0; // it is checked no more while its group does not run
}
