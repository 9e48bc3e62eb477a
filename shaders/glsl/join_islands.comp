#version 460
// Joins the islands of particles that touched each other in the last substep.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "islands.glsl"

layout(std430, binding = 3) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 4) readonly buffer Lists { uvec2 lists[]; };
#define HITS_BINDING 5
#include "hit_masks.glsl"
layout(push_constant) uniform Push { SleepPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (!isAwake(i)) return;
    const uvec2 list = lists[i];
    for (uint word = 0u; word < wordsOf(list); ++word) {
        for (uint at = hits[hitWord(push.count, i, list, word)].x; at != 0u; at &= at - 1u) {
            const uint j = contacts[list.x + 32u * word + findLSB(at)].other;
            if (j < i && isAwake(j)) join(i, j);
        }
    }
}
