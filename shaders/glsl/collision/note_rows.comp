#version 460
// Counts the contacts of particles and faces, or of edges, of two bodies in a substep.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "events/events.h"
layout(push_constant) uniform Push { EventPush push; };
#include "events/partners.glsl"

layout(std430, binding = 2) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 3) readonly buffer Candidates { ContactCandidate candidates[]; };
layout(std430, binding = 4) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 5) readonly buffer Directions { vec4 directions[]; }; // w: depth [m]
#define TOUCHING_BINDING 6
#include "collision/touching.glsl"

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    for (uint k = firstList(i); k < lastList(i); ++k) {
        if (areEdges && (corners[k] & 3u) != 0u) continue; // at the first end of each edge
        const uint owner = listOf(k);
        const uvec2 list = lists[owner];
        for (uint element = list.x; element < list.x + list.y; ++element) {
            if (!(directions[element].w > 0.0)) continue;
            const uint all[4] = touchingOf(owner, candidates[element].other);
            bool isAwake = false;
            for (uint m = 0u; m < 4u; ++m) isAwake = isAwake || velocities[all[m]].w > 0.0;
            if (isAwake) addMeeting(bodies[all[0]], bodies[all[areEdges ? 2 : 1]]);
        }
    }
}
