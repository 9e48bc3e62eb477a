#version 460
// Solves one color of the bends of `gauss_seidel` in place, as solve_distance_color.comp does for links: no two bends
// of a color touch the same moving particle.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "constraints/bend.glsl"

layout(std430, binding = 0) buffer Corrections { vec4 corrections[]; }; // ParticleCorrection
layout(std140, binding = 1) uniform Step { StepParams step; };
layout(std430, binding = 2) readonly buffer Bends { ColoredBend bends[]; };
layout(std430, binding = 3) readonly buffer Positions { vec4 positions[]; }; // predicted; w = inverse mass [1/kg]
layout(std430, binding = 4) buffer Multipliers { vec4 multipliers[]; };
layout(constant_id = 1) const bool hasMultipliers = false;
layout(push_constant) uniform Push { BendColorPush push; };

void main() {
    const uint k = push.first + itemIndex(push.count);
    const ColoredBend bend = bends[k];
    const vec4 a = positions[bend.a], b = positions[bend.b], c = positions[bend.c];
    const vec3 ca = corrections[bend.a].xyz, cb = corrections[bend.b].xyz, cc = corrections[bend.c].xyz;
    const float alpha = scaledCompliance(bend.compliance, step.h);
    const vec3 value = bendValue(a.xyz, b.xyz, c.xyz) + bendValue(ca, cb, cc);
    vec3 lambda = vec3(0.0);
    if (hasMultipliers && push.isFirst == 0u) lambda = multipliers[k].xyz;
    const vec3 w = vec3(a.w, b.w, c.w), change = solveBend(value, w, alpha, lambda);
    if (a.w > 0.0) corrections[bend.a].xyz = ca + a.w * change;
    if (b.w > 0.0) corrections[bend.b].xyz = cb - 2.0 * b.w * change;
    if (c.w > 0.0) corrections[bend.c].xyz = cc + c.w * change;
    if (hasMultipliers && w != vec3(0.0)) multipliers[k] = vec4(lambda + change, 0.0);
}
