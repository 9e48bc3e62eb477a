#version 460
// The constraint pass of `jacobi`: each distance constraint writes the correction of either end to its own two slots
// of the correction buffer; no other invocation writes there, so there are no atomics. Rigid constraints have alpha =
// 0 and keep no multiplier.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "constraints/distance.glsl"

layout(std430, binding = 0) readonly buffer Edges { DistanceEdge edges[]; };
layout(std430, binding = 1) readonly buffer Positions { vec4 positions[]; }; // w = inverse mass [1/kg]
layout(std430, binding = 2) writeonly buffer Corrections { vec4 corrections[]; };
layout(std140, binding = 3) uniform Step { StepParams step; };
layout(std430, binding = 4) buffer Multipliers { DistanceMultiplier multipliers[]; };
layout(std430, binding = 5) readonly buffer Velocities { vec4 velocities[]; };
layout(constant_id = 1) const bool hasMultipliers = false; // a constraint is compliant
layout(constant_id = 12) const bool hasDamping = false;
layout(push_constant) uniform Push { DampedIterationPush push; };

// Displacement of a particle in this substep: v includes the whole of h g, the displacement half of it.
vec3 moved(uint i) {
    const vec4 v = velocities[i];
    return v.w > 0.0 ? step.h * (v.xyz - 0.5 * step.h * step.gravity.xyz) : vec3(0.0);
}

void main() {
    const uint c = itemIndex(push.count);
    if (c >= push.count) return;
    const DistanceEdge edge = edges[c];
    const vec4 a = positions[edge.a], b = positions[edge.b];
    float lambda = 0.0, alpha = 0.0;
    if (hasMultipliers) {
        lambda = push.isFirst != 0u ? 0.0 : multipliers[c].lambda;
        alpha = scaledCompliance(edge.compliance, step.h);
    }
    DistanceChange change;
    if (hasDamping) {
        // damping coefficient dampingTime / compliance: gamma = dampingTime / h; rigid constraints have none
        const float gamma = alpha > 0.0 ? push.dampingTime / step.h : 0.0;
        change = solveDampedDistance(b.xyz - a.xyz, a.w + b.w, edge.restLength, alpha, lambda, gamma, moved(edge.b) - moved(edge.a));
    } else {
        change = solveDistance(b.xyz - a.xyz, a.w + b.w, edge.restLength, alpha, lambda);
    }
    if (hasMultipliers) multipliers[c].lambda = lambda + change.lambda * multipliers[c].share;
    const uint slot = push.firstSlot + 2u * c;
    corrections[slot] = vec4(-a.w * change.lambda * change.n, 0.0);
    corrections[slot + 1u] = vec4(b.w * change.lambda * change.n, 0.0);
}
