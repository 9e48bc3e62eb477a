#version 460
// Counts the pairs of particles of two bodies that touch in a substep, or stand nearer than their reach, as
// join_islands does. The lists of both have a pair: the one with the larger slot counts it, if both may move.
#extension GL_GOOGLE_include_directive : require
#define MAY_RUN_LISTED
#include "common/kernel.glsl"
#include "common/contacts.glsl"
#include "events/events.h"
layout(push_constant) uniform Push { EventPush push; };
#include "events/partners.glsl"

layout(std430, binding = 2) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 3) readonly buffer Candidates { ContactCandidate candidates[]; };
layout(std430, binding = 4) readonly buffer Lists { uvec2 lists[]; };
#define HITS_BINDING 5
#include "common/hit_masks.glsl"
layout(std430, binding = 6) readonly buffer Touching { vec4 touching[]; }; // positions with which contacts were counted [m]
layout(std140, binding = 7) uniform Bounds { GridBounds bounds; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count || isPadding(bounds.listed)) return;
    const uint body = bodies[i];
    if (body == NO_BODY || velocities[i].w == 0.0) return;
    const uvec2 list = lists[i];
    for (uint word = 0u; word < wordsOf(list); ++word) {
        const uint hit = hits[hitWord(push.count, i, list, word)].x, from = list.x + 32u * word;
        for (uint slot = from; slot < min(from + 32u, list.x + list.y); ++slot) {
            const ContactCandidate candidate = candidates[slot];
            const uint j = candidate.other;
            if (bodies[j] == body || j > i && velocities[j].w > 0.0) continue;
            const bool isHit = (hit >> (slot - from) & 1u) != 0u;
            if (isHit || touches(touching[i].xyz - touching[j].xyz, candidate.reach)) addMeeting(body, bodies[j]);
        }
    }
}
