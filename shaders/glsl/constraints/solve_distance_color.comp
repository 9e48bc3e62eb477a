#version 460
// Solves the distance constraints of one color of `gauss_seidel` in place. No two of them touch the same moving
// particle, so no invocation reads what another writes; static particles may be shared and are never written. The
// color is padded to whole work groups with constraints of a static padding particle: no lane is masked off
// (lavapipe).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_spirv_intrinsics : require
#define ALIASED spirv_decorate(20) // the buffer is bound twice, and written through one binding: Aliased
#include "common/kernel.glsl"
#include "constraints/distance.glsl"

// Buffers: DistanceEdge; predicted positions, w = inverse mass [1/kg]; ParticleCorrection; l n and l [N s^2]. An
// element that is fetched as texels and also written is fetched by the invocation that writes it, to compute the
// value that it writes.
ALIASED layout(std430, binding = 0) writeonly buffer Corrections { vec4 corrections[]; };
layout(std140, binding = 1) uniform Step { StepParams step; };
#include "common/fetched.glsl"
FETCHED_UVEC4(2, Edges, edgeAt)
FETCHED_VEC4(3, Positions, positionAt)
ALIASED layout(std430, binding = 4) readonly buffer CorrectionsBefore { vec4 correctionsBefore[]; };
ALIASED TEXEL_TWIN(4, samplerBuffer, correctionTexels);
vec3 correctionBefore(uint i) {
    if (usesTexels) return texelFetch(correctionTexels, int(i)).xyz;
    return correctionsBefore[i].xyz;
}
layout(constant_id = 1) const bool hasMultipliers = false;
ALIASED layout(std430, binding = 5) writeonly buffer Multipliers { vec4 multipliers[]; };
ALIASED layout(std430, binding = 6) readonly buffer MultipliersBefore { vec4 multipliersBefore[]; };
ALIASED TEXEL_TWIN(6, samplerBuffer, multiplierTexels);
float multiplierBefore(uint c) {
    if (usesTexels) return texelFetch(multiplierTexels, int(c)).w;
    return multipliersBefore[c].w;
}
layout(push_constant) uniform Push { ColorPush push; };

// The multiplier that starts the next substep. If a constraint is too stiff for a substep the pull lags behind the
// motion: a share above (1 + alpha / w) / 2 gains energy at any order of the colors, and a smaller one at unlucky
// orders (docs/performance/solvers.md). The kept multiplier may move the ends by a twentieth of their distance at most, for
// heavy ends of light chains.
float kept(float lambda, float w, float alpha, float restLength) {
    const float share = min(push.warmStart, 0.3 + 0.6 * alpha / w);
    const float most = 0.05 * restLength / w;
    return clamp(share * lambda, -most, most);
}

void main() {
    const uint c = push.first + itemIndex(push.count);
    const uvec4 edge = edgeAt(c);
    const float restLength = uintBitsToFloat(edge.z);
    const float alpha = scaledCompliance(uintBitsToFloat(edge.w), step.h);
    const vec4 a = positionAt(edge.x), b = positionAt(edge.y);
    const vec3 ca = correctionBefore(edge.x), cb = correctionBefore(edge.y);
    const float w = a.w + b.w;
    float lambda = 0.0;
    if (hasMultipliers) lambda = multiplierBefore(c) * (push.isOpening != 0u ? step.multiplierScale : 1.0);
    const DistanceChange change = solveDistance(b.xyz - a.xyz + (cb - ca), w, restLength, alpha, lambda);
    const vec3 impulse = change.lambda * change.n;
    if (a.w > 0.0) corrections[edge.x].xyz = ca - a.w * impulse;
    if (b.w > 0.0) corrections[edge.y].xyz = cb + b.w * impulse;
    if (!hasMultipliers) return;
    const float solved = lambda + change.lambda;
    const float next = push.isClosing != 0u ? kept(solved, w, alpha, restLength) : solved;
    if (w > 0.0) multipliers[c] = vec4(next * change.n, next);
}
