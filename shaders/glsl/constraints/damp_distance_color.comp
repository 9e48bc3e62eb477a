#version 460
// Internal damping of one color of `gauss_seidel`, in place on the velocities at the end of a substep: c = damping
// time / compliance along a link, implicit for each link, so that every time is stable and angular momentum is kept.
// At rest it is 0; as a term of the constraint (XPBD [Macklin 2016], eq. 26) it would multiply the compliance that a
// sweep adds by 1 + damping time / h.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) buffer Velocities { vec4 velocities[]; }; // [m/s]; w = inverse mass [1/kg]
layout(std140, binding = 1) uniform Step { StepParams step; };
layout(std430, binding = 2) readonly buffer Edges { DistanceEdge edges[]; };
layout(std430, binding = 3) readonly buffer Positions { vec4 positions[]; }; // [m]
layout(push_constant) uniform Push { DampColorPush push; };

void main() {
    const DistanceEdge edge = edges[push.first + itemIndex(push.count)];
    const vec4 a = velocities[edge.a], b = velocities[edge.b];
    const vec3 halfKick = 0.5 * step.h * step.gravity.xyz; // part of the velocity of moving particles even at rest
    const vec3 slip = (b.xyz - (b.w > 0.0 ? halfKick : vec3(0.0))) - (a.xyz - (a.w > 0.0 ? halfKick : vec3(0.0)));
    const vec3 d = positions[edge.b].xyz - positions[edge.a].xyz;
    const float distance = length(d);
    const vec3 n = distance > 1e-12 ? d / distance : vec3(0.0);
    const float give = min(edge.compliance / (push.dampingTime * step.h), 1e30); // 1 / (c h); a rigid link has no damping
    const float impulse = edge.compliance > 0.0 ? dot(slip, n) / (a.w + b.w + give) : 0.0;
    if (a.w > 0.0) velocities[edge.a].xyz = a.xyz + a.w * impulse * n;
    if (b.w > 0.0) velocities[edge.b].xyz = b.xyz - b.w * impulse * n;
}
