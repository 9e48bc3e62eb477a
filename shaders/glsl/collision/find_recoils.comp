#version 460
// Recoils, first pass, at the end of a substep: lists the fast particles with few contacts of which one parts fast
// (sim/collision/recoils.hpp), and plans the second pass if there are any.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/contacts.glsl"
#include "common/fetched.glsl"
FETCHED_VEC4(0, Touching, touchingAt)   // positions at which contacts were found; contacts x inverse mass
FETCHED_UVEC2(1, Contacts, contactAt)   // ContactCandidate
FETCHED_VEC4(2, Velocities, velocityAt) // after the substep; w = inverse mass [1/kg]
layout(std430, binding = 3) readonly buffer Lists { uvec2 lists[]; };
layout(std140, binding = 4) uniform Step { StepParams step; };
layout(std430, binding = 5) writeonly buffer Members { uint members[]; };
layout(std430, binding = 6) writeonly buffer Degrees { uint degrees[]; };
layout(std430, binding = 7) buffer Arguments { DispatchArguments arguments[]; }; // by substep; unused0: number of members
layout(std430, binding = 8) readonly buffer Near { uvec2 near[]; };              // count_contacts
#include "forces/received_sections.glsl"
FETCHED_UVEC4(9, Received, receivedBits) // received.glsl
vec4 receivedAt(uint element) { return uintBitsToFloat(receivedBits(element)); }
layout(push_constant) uniform Push { RecoilPush push; };
#include "forces/recoil_speed.glsl"
#include "common/few_contacts.glsl"

bool partsFast(uint i, uvec2 few, vec3 x, vec3 v) {
    bool isFast = false;
    const uint first = lists[i].x;
    for (uint n = 0u; n < countOf(few); ++n) {
        const uvec2 candidate = contactAt(first + placeOf(few, n));
        const vec3 d = x - touchingAt(candidate.x).xyz;
        const float speed = dot3(d, v - velocityAt(candidate.x).xyz); // x |d|
        const float least = leastRecoil(uintBitsToFloat(candidate.y));
        isFast = isFast || speed > 0.0 && speed * speed > least * least * dot3(d, d);
    }
    const vec4 fixedly = receivedAt(sectionElement(2u, i));
    const float speed = dot3(fixedly.xyz, v) - fixedly.w, least = leastRecoil(leastReach);
    return isFast || speed > 0.0 && speed * speed > least * least * dot3(fixedly.xyz, fixedly.xyz);
}

void main() {
    const uint i = itemIndex(push.count);
    const vec4 velocity = velocityAt(i), touching = touchingAt(i);
    const uvec2 few = hasFew(touching.w, velocity.w) && velocity.w > 0.0 ? near[i] : uvec2(0u);
    bool isFast = false;
    // A loop: on a software device, code under a condition costs its time even if it does not run.
    for (uint once = countOf(few) != 0u && areFew(few) && mayRecoil(velocity.xyz) ? 1u : 0u; once != 0u; --once)
        isFast = partsFast(i, few, touching.xyz, velocity.xyz);
    degrees[i] = 0u;
    if (!isFast) return;
    members[atomicAdd(arguments[push.substep].unused0, 1u)] = i;
    arguments[push.substep].groupsX = 1u;
    arguments[push.substep].groupsY = 1u;
    arguments[push.substep].groupsZ = 1u;
}
