// One substep of `split` for one particle: stiffness-clamped, mass-split Jacobi as a gather (methods: D).
// A particle reads its neighbours' stored positions y = x + theta h v, sums its links, kicks, drifts and writes itself:
// one pass and one barrier a substep. Both ends of a link compute bit-equal, opposite impulses, so momentum is exact.
//
//   kick   v' = f (v + k (g + sum_c dl_c n_c w / H^2)),  dl_c = -C_c(y) min(k_c H^2, kappa_i, kappa_j)
//   drift  x' = x + h v',  y' = x' + theta h v'
//
// k is h, but (hPrevious + h) / 2 in a step's first substep: v lives half a substep behind x (leapfrog), which starts
// the motion with a half-kick and follows a changing h. H is h, there the longer of both: it bounds what links can do
// in the whole kick. kappa_i = omega / (2 n_i w_i) is stored in positions.w.
#extension GL_EXT_control_flow_attributes : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; }; // y, kappa [kg]
layout(std430, binding = 1) writeonly buffer NextPositions { vec4 nextPositions[]; };
layout(std430, binding = 2) buffer Velocities { vec4 velocities[]; }; // v [m/s], w [1/kg]
layout(std140, binding = 3) uniform Step { StepParams step; };
#define LINK_BINDING 4
#ifdef HAS_PLANES
#include "planes.glsl"
layout(std430, binding = 4) readonly buffer Planes { PlaneCollider planes[]; };
layout(std430, binding = 5) readonly buffer ContactOffsets { float contactOffsets[]; };
#undef LINK_BINDING
#define LINK_BINDING 6
#endif
#if defined LINKS_PACKED
layout(constant_id = 3) const uint groupEnd0 = 1; // one past the last slot of a group
layout(constant_id = 4) const uint groupEnd1 = 1;
layout(constant_id = 5) const uint groupEnd2 = 1;
layout(std430, binding = LINK_BINDING) readonly buffer Links { uint links[]; };
layout(push_constant) uniform Push { PackedSubstepPush push; };
#else
#if defined LINKS_GENERAL
layout(std430, binding = LINK_BINDING) readonly buffer Links { uvec4 links[]; }; // SplitLink, in one load
#endif
layout(push_constant) uniform Push { SubstepPush push; };
#endif

#if defined LINKS_GENERAL || defined LINKS_PACKED
layout(constant_id = 1) const uint degree = 1; // slots per particle, padded

#if defined LINKS_PACKED
// Selects, because an array indexed by s would be looked up by every lane.
float ofGroup(uint s, float values[PACKED_GROUPS]) {
    return s < groupEnd0 ? values[0] : s < groupEnd1 ? values[1] : s < groupEnd2 ? values[2] : values[3];
}
#endif

SplitLink linkAt(uint s, uint i) {
    const uint index = (i / LINK_BLOCK * degree + s) * LINK_BLOCK + i % LINK_BLOCK;
#if defined LINKS_PACKED
    const uint word = links[index];
    const float stiffness = ofGroup(s, push.units) * float((word >> PACKED_END_BITS) + 1u);
    return SplitLink(word & (1u << PACKED_END_BITS) - 1u, ofGroup(s, push.restLengths), stiffness, 0u);
#else
    const uvec4 link = links[index];
    return SplitLink(link.x, uintBitsToFloat(link.y), uintBitsToFloat(link.z), 0u);
#endif
}

// The sum over links of dl_c n_c [kg m]. Padding (a link to oneself) and coincident ends contribute exactly 0.
vec3 linkImpulses(uint i, vec4 y, float hh) {
    vec3 sum = vec3(0.0);
    // unrolled whatever its length: a loop brings the lane mask back (18 slots: 25 % slower)
    [[unroll]] for (uint s = 0u; s < degree; ++s) {
        const SplitLink link = linkAt(s, i);
        const vec4 yj = positions[link.other];
        const vec3 d = yj.xyz - y.xyz;
        const float stiffness = min(link.stiffness * hh, min(y.w, yj.w));
        sum += stiffness * (1.0 - link.restLength * inversesqrt(dot(d, d) + 1e-30)) * d;
    }
    return sum;
}
#endif

void main() {
    // No early out: buffers are padded to whole groups. On lavapipe a lane mask turns every load into eight branches.
    const uint i = itemIndex(push.count);
    const vec4 y = positions[i];
    const vec4 velocity = velocities[i];
    const float w = velocity.w, h = step.h;
    const float kick = push.isFirst != 0u ? 0.5 * (step.hPrevious + h) : h;
    const float thetaH = push.isFirst != 0u ? step.thetaHPrevious : step.thetaH;

    vec3 v = velocity.xyz;
#if defined LINKS_GENERAL || defined LINKS_PACKED
    const float longest = push.isFirst != 0u ? max(step.hPrevious, h) : h;
    v += kick / (longest * longest) * w * linkImpulses(i, y, longest * longest);
#endif
    if (w > 0.0) v += kick * step.gravity.xyz;
    v *= step.velocityFactor;
    vec3 x = y.xyz - thetaH * velocity.xyz + h * v;
#ifdef HAS_PLANES
    if (w > 0.0) {
        Motion motion = Motion(x, v, h * v);
        uint touched = 0u;
        for (uint p = 0u; p < planeCount; ++p) {
            if (projectOntoPlane(planes[p], contactOffsets[i], h, motion)) touched |= 1u << p;
        }
        for (uint p = 0u; p < planeCount; ++p) {
            if ((touched & 1u << p) != 0u) motion.v += rebound(planes[p], step.restSpeed, velocity.xyz, motion.v);
        }
        x = motion.x;
        v = motion.v;
    }
#endif
    velocities[i] = vec4(v, w);
    nextPositions[i] = vec4(x + step.thetaH * v, y.w);
}
