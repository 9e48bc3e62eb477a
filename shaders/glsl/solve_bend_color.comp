#version 460
// One color of the bends of `gauss_seidel`, in place, as solve_distance_color.comp does for links: no two of them touch the
// same moving particle. XPBD [Macklin 2016], eq. 18, for the vector constraint C = x_a - 2 x_b + x_c (solve_bends.comp).
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) buffer Corrections { vec4 corrections[]; }; // ParticleCorrection
layout(std140, binding = 1) uniform Step { StepParams step; };
layout(std430, binding = 2) readonly buffer Bends { ColoredBend bends[]; };
layout(std430, binding = 3) readonly buffer Positions { vec4 positions[]; }; // predicted; w = inverse mass [1/kg]
#ifdef HAS_MULTIPLIERS
layout(std430, binding = 4) buffer Multipliers { vec4 multipliers[]; };
#endif
layout(push_constant) uniform Push { BendColorPush push; };

void main() {
    const uint k = push.first + itemIndex(push.count);
    const ColoredBend bend = bends[k];
    const vec4 a = positions[bend.a], b = positions[bend.b], c = positions[bend.c];
    const vec3 ca = corrections[bend.a].xyz, cb = corrections[bend.b].xyz, cc = corrections[bend.c].xyz;
    const float alpha = min(bend.compliance / (step.h * step.h), 1e30); // Inf would turn into NaN
    vec3 value = (a.xyz - b.xyz) + (c.xyz - b.xyz) + ((ca - cb) + (cc - cb));
#ifdef HAS_MULTIPLIERS
    const vec3 lambda = push.isFirst != 0u ? vec3(0.0) : multipliers[k].xyz;
    value += alpha * lambda;
#endif
    const float w = a.w + 4.0 * b.w + c.w;
    const vec3 change = -value / (w + alpha);
    if (a.w > 0.0) corrections[bend.a].xyz = ca + a.w * change;
    if (b.w > 0.0) corrections[bend.b].xyz = cb - 2.0 * b.w * change;
    if (c.w > 0.0) corrections[bend.c].xyz = cc + c.w * change;
#ifdef HAS_MULTIPLIERS
    if (w > 0.0) multipliers[k] = vec4(lambda + change, 0.0);
#endif
}
