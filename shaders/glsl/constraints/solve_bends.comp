#version 460
// The bends of `jacobi` (bend.glsl): three correction slots a bend.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "constraints/bend.glsl"

layout(std430, binding = 0) readonly buffer Bends { BendRow bends[]; };
layout(std430, binding = 1) readonly buffer Positions { vec4 positions[]; }; // w = inverse mass [1/kg]
layout(std430, binding = 2) writeonly buffer Corrections { vec4 corrections[]; };
layout(std140, binding = 3) uniform Step { StepParams step; };
layout(std430, binding = 4) buffer Multipliers { vec4 multipliers[]; };
layout(push_constant) uniform Push { IterationPush push; };

void main() {
    const uint c = itemIndex(push.count);
    if (c >= push.count) return;
    const BendRow bend = bends[c];
    const vec4 a = positions[bend.a], b = positions[bend.b], e = positions[bend.c];
    const float alpha = scaledCompliance(bend.compliance, step.h);
    const vec3 lambda = push.isFirst != 0u ? vec3(0.0) : multipliers[c].xyz;
    const vec3 change = solveBend(bendValue(a.xyz, b.xyz, e.xyz), vec3(a.w, b.w, e.w), alpha, lambda);
    multipliers[c] = vec4(lambda + bend.share * change, 0.0);
    const uint slot = push.firstSlot + 3u * c;
    corrections[slot] = vec4(a.w * change, 0.0);
    corrections[slot + 1u] = vec4(-2.0 * b.w * change, 0.0);
    corrections[slot + 2u] = vec4(e.w * change, 0.0);
}
