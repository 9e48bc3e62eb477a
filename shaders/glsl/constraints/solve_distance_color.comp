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
#ifdef TEXELS
layout(binding = 2) uniform usamplerBuffer edges;
layout(binding = 3) uniform samplerBuffer positions;
ALIASED layout(binding = 4) uniform samplerBuffer correctionsBefore;
#define FETCH(buffer, i) texelFetch(buffer, int(i))
#else
layout(std430, binding = 2) readonly buffer Edges { uvec4 edges[]; };
layout(std430, binding = 3) readonly buffer Positions { vec4 positions[]; };
ALIASED layout(std430, binding = 4) readonly buffer CorrectionsBefore { vec4 correctionsBefore[]; };
#define FETCH(buffer, i) buffer[i]
#endif
#ifdef HAS_MULTIPLIERS
ALIASED layout(std430, binding = 5) writeonly buffer Multipliers { vec4 multipliers[]; };
#ifdef TEXELS
ALIASED layout(binding = 6) uniform samplerBuffer multipliersBefore;
#else
ALIASED layout(std430, binding = 6) readonly buffer MultipliersBefore { vec4 multipliersBefore[]; };
#endif
#endif
layout(push_constant) uniform Push { ColorPush push; };

#ifdef HAS_MULTIPLIERS
// The multiplier that starts the next substep. If a constraint is too stiff for a substep the pull lags behind the
// motion: a share above (1 + alpha / w) / 2 gains energy at any order of the colors, and a smaller one at unlucky
// orders (docs/performance.md). The kept multiplier may move the ends by a twentieth of their distance at most, for
// heavy ends of light chains.
float kept(float lambda, float w, float alpha, float restLength) {
    const float share = min(push.warmStart, 0.3 + 0.6 * alpha / w);
    const float most = 0.05 * restLength / w;
    return clamp(share * lambda, -most, most);
}
#endif

void main() {
    const uint c = push.first + itemIndex(push.count);
    const uvec4 edge = FETCH(edges, c);
    const float restLength = uintBitsToFloat(edge.z);
    const float alpha = scaledCompliance(uintBitsToFloat(edge.w), step.h);
    const vec4 a = FETCH(positions, edge.x), b = FETCH(positions, edge.y);
    const vec3 ca = FETCH(correctionsBefore, edge.x).xyz, cb = FETCH(correctionsBefore, edge.y).xyz;
    const float w = a.w + b.w;
#ifdef HAS_MULTIPLIERS
    const float lambda = FETCH(multipliersBefore, c).w * (push.isOpening != 0u ? step.multiplierScale : 1.0);
#else
    const float lambda = 0.0;
#endif
    const DistanceChange change = solveDistance(b.xyz - a.xyz + (cb - ca), w, restLength, alpha, lambda);
    const vec3 impulse = change.lambda * change.n;
    if (a.w > 0.0) corrections[edge.x].xyz = ca - a.w * impulse;
    if (b.w > 0.0) corrections[edge.y].xyz = cb + b.w * impulse;
#ifdef HAS_MULTIPLIERS
    const float solved = lambda + change.lambda;
    const float next = push.isClosing != 0u ? kept(solved, w, alpha, restLength) : solved;
    if (w > 0.0) multipliers[c] = vec4(next * change.n, next);
#endif
}
