#version 460
// `split` for any graph: a particle's links are listed in slots, equally many for every particle of the scene, or in
// ranges (see the forms in split_links.glsl).
#extension GL_GOOGLE_include_directive : require
#define MAY_RUN_LISTED
#include "solvers/split.glsl"
#include "solvers/split_links.glsl"
#ifndef LINKS_PACKED
#include "solvers/gather_terms.glsl"
#endif

// Padding is a link to the particle itself and contributes exactly 0.
vec3 impulseOf(uint index, uint s, vec4 y, vec3 v, float hh, inout SYMMETRIC bearing) {
#ifdef LINKS_PACKED
    const uint word = LINK(index);
    const vec4 yj = POSITION(word & (1u << PACKED_END_BITS) - 1u);
    const float clamped = min(ofGroup(s, push.units) * hh, ofGroup(s, push.shares) * min(y.w, yj.w));
    const float units = float((word >> PACKED_END_BITS) + 1u), restLength = ofGroup(s, push.restLengths);
    if (findsTimes) bearing += borneBy(y.xyz, yj.xyz, restLength, units * ofGroup(s, push.shares));
    return linkImpulse(y.xyz, yj.xyz, restLength, units * clamped);
#else
    const uvec4 link = LINK(index);
    const vec4 yj = POSITION(link.x);
    const float clamped = min(uintBitsToFloat(link.z) * hh, uintBitsToFloat(link.w) * min(y.w, yj.w));
    if (findsTimes) bearing += borneBy(y.xyz, yj.xyz, uintBitsToFloat(link.y), uintBitsToFloat(link.w));
    vec3 impulse = linkImpulse(y.xyz, yj.xyz, uintBitsToFloat(link.y), clamped);
    if (hasDamping) {
        const float most = uintBitsToFloat(link.w) * min(y.w, yj.w);
        impulse += dampingImpulse(yj.xyz - y.xyz, velocities[link.x].xyz - v, uintBitsToFloat(link.z), most, sqrt(hh));
    }
    return impulse;
#endif
}

#ifdef LINKS_RANGED
vec3 linkImpulses(uint i, vec4 y, vec3 v, float hh, inout SYMMETRIC bearing) {
    vec3 sum = vec3(0.0);
    const uint end = firstLinks[i + 1u];
    for (uint index = firstLinks[i]; index < end; ++index) sum += impulseOf(index, 0u, y, v, hh, bearing);
    return sum;
}
#else
layout(constant_id = 1) const uint degree = 0; // slots per particle, padded

vec3 linkImpulses(uint i, vec4 y, vec3 v, float hh, inout SYMMETRIC bearing) {
    vec3 sum = vec3(0.0);
    const uint first = i / LINK_BLOCK * degree * LINK_BLOCK + i % LINK_BLOCK;
    // unrolled whatever its length: a loop brings the lane mask back (18 slots: 25 % slower)
    [[unroll]] for (uint s = 0u; s < degree; ++s) sum += impulseOf(first + s * LINK_BLOCK, s, y, v, hh, bearing);
    return sum;
}
#endif

void main() {
    // No early out: buffers are padded to whole groups. On lavapipe a lane mask turns every load into eight branches.
    const uint i = itemIndex(push.count);
    const Substep substep = substepOf(push.isFirst != 0u);
    vec4 y = POSITION(i);
    const vec4 velocity = velocities[i];
    SYMMETRIC bearing = SYMMETRIC(0.0);
    vec3 sum = linkImpulses(i, y, velocity.xyz, substep.hh, bearing);
    if (findsTimes) y.w = timeFor(bearing, timesAtRest[i], y.w, velocity.w);
#ifndef LINKS_PACKED
    if (bendDegree > 0u) sum += bendImpulses(i, substep.hh);
#endif
    advance(i, y, velocity, sum, substep);
}
