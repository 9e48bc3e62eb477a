#version 460
// Opens a substep of `jacobi`: x* = x + h v + h^2 g / 2 and v + h g, exact in free fall at any h (the half-kick form).
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/remainder.glsl"

layout(std430, binding = 0) buffer Positions { vec4 positions[]; };   // w = inverse mass [1/kg]
layout(std430, binding = 1) buffer Velocities { vec4 velocities[]; }; // w = inverse mass
layout(std140, binding = 2) uniform Step { StepParams step; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const vec4 velocity = velocities[i];
    if (velocity.w == 0.0) return;
    const vec3 dv = step.h * step.gravity.xyz;
    const vec3 way = step.h * (velocity.xyz + 0.5 * dv);
    if (hasRemainders) {
        const uint r = remainderOf(positions.length(), i);
        const Sum sum = exactSum(positions[i].xyz, way + positions[r].xyz);
        positions[i].xyz = sum.rounded;
        positions[r].xyz = sum.remainder;
    } else {
        positions[i].xyz += way;
    }
    velocities[i].xyz = velocity.xyz + dv;
}
