#version 460
// Marks contacts in the shown state: particles on planes and colliders, and of the pairs in the solver's contact
// lists those that touch: particles with particles, and particles on faces. Marks are in any order.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/triangle.glsl"
#include "rigid/pose.glsl"
#include "viewer/values.h"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Particles { MarkParticle particles[]; };
layout(std430, binding = 2) readonly buffer BySlot { uint bySlot[]; }; // particle, or NO_PARTICLE
layout(std430, binding = 3) readonly buffer Walls { MarkWall walls[]; };
layout(std430, binding = 4) readonly buffer Pairs { uvec2 pairs[]; }; // ContactCandidate
layout(std430, binding = 5) readonly buffer PairLists { uvec2 pairLists[]; };
layout(std430, binding = 6) readonly buffer Faces { ContactFace faces[]; };
layout(std430, binding = 7) readonly buffer FacePairs { uvec2 facePairs[]; }; // ContactCandidate
layout(std430, binding = 8) readonly buffer FaceLists { uvec2 faceLists[]; };
layout(std430, binding = 9) writeonly buffer Marks { ContactMark marks[]; };
layout(std430, binding = 10) buffer Draw { MarkDraw draw; };
layout(std430, binding = 11) readonly buffer Pieces { uint pieces[]; }; // one per particle
layout(push_constant) uniform Push { MarkPush push; };
#include "viewer/marks.glsl"

void markWall(MarkWall wall, vec3 x, float offset, float nearness) {
    vec3 n = wall.core.xyz;
    float gap = dot(n, x) - wall.core.w;
    if (wall.position.w == 0.0) {
        const ColliderPose pose = ColliderPose(wall.position, wall.rotation);
        const vec3 s = toLocal(pose, x), outward = s - clamp(s, -wall.core.xyz, wall.core.xyz);
        gap = length(outward) - wall.core.w;
        n = rotated(wall.rotation, outward / max(length(outward), 1e-20));
    }
    if (gap - offset < nearness) mark(x - gap * n, n, 0.0);
}

void markPairs(uint i, uint slot, vec3 x) {
    const uvec2 list = pairLists[slot];
    for (uint element = list.x; element < list.x + list.y; ++element) {
        const uvec2 candidate = pairs[element];
        const vec3 d = x - placeOf(candidate.x);
        const float distance = length(d);
        if (isGone(candidate.x)) continue;
        if ((bySlot[candidate.x] <= i && push.only == NO_PARTICLE) || distance > 1.02 * uintBitsToFloat(candidate.y)) continue; // marked once per pair
        mark(x - 0.5 * d, d / max(distance, 1e-20), 1.0);
    }
}

void markFaces(uint slot, vec3 x) {
    const uvec2 list = faceLists[slot];
    for (uint element = list.x; element < list.x + list.y; ++element) {
        const uvec2 candidate = facePairs[element];
        const ContactFace face = faces[candidate.x];
        if (isGone(face.a)) continue;
        const vec3 a = placeOf(face.a);
        const Nearest nearest = nearestOf(x - a, triangleOf(placeOf(face.b) - a, placeOf(face.c) - a));
        const float distance = length(nearest.d);
        if (distance > 1.02 * abs(uintBitsToFloat(candidate.y))) continue;
        mark(x - nearest.d, nearest.d / max(distance, 1e-20), 2.0);
    }
}

void main() {
    const bool isOne = push.only != NO_PARTICLE;
    const uint items = isOne ? 1u : push.count, item = itemIndex(items);
    if (item >= items) return;
    const uint i = isOne ? push.only : item;
    const MarkParticle own = particles[i];
    if (isGone(own.slot)) return;
    const vec3 x = positions[i].xyz;
    if (positions[i].w > 0.0)
        for (uint w = push.firstWall; w < push.firstWall + push.walls; ++w) markWall(walls[w], x, own.contactOffset, own.nearness);
    if (push.hasPairs > 0u) markPairs(i, own.slot, x);
    if (push.hasFaces > 0u) markFaces(own.slot, x);
}
