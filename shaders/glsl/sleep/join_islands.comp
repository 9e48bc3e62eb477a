#version 460
// Joins the islands of particles that touched each other in the last substep, or stood nearer than their reach: then an awake one would
// wake the other (wake_touched.comp), though a rest distance that they keep holds their contact open.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/contacts.glsl"
#include "sleep/islands.glsl"

layout(std430, binding = 3) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 4) readonly buffer Lists { uvec2 lists[]; };
#define HITS_BINDING 5
#include "common/hit_masks.glsl"
layout(std430, binding = 6) readonly buffer Touching { vec4 touching[]; }; // positions with which contacts were counted [m]
layout(push_constant) uniform Push { SleepPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (!isAwake(i)) return;
    const uvec2 list = lists[i];
    for (uint word = 0u; word < wordsOf(list); ++word) {
        const uint hit = hits[hitWord(push.count, i, list, word)].x, from = list.x + 32u * word;
        for (uint slot = from; slot < min(from + 32u, list.x + list.y); ++slot) {
            const ContactCandidate candidate = contacts[slot];
            const uint j = candidate.other;
            const bool isHit = (hit >> (slot - from) & 1u) != 0u;
            if (j < i && isAwake(j) && (isHit || touches(touching[i].xyz - touching[j].xyz, candidate.reach))) join(i, j);
        }
    }
}
