#version 460
// Joins the islands of a particle and the corners of the faces that it touched in the last substep, or of the ends of
// edges that touched: a particle handles the edges that end at it.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "sleep/islands.glsl"

layout(std430, binding = 3) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 4) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 5) readonly buffer Directions { vec4 directions[]; }; // w: depth [m]
layout(push_constant) uniform Push { SleepPush push; };
#define TOUCHING_BINDING 6
#include "collision/touching.glsl"

void main() {
    const uint i = itemIndex(push.count);
    for (uint k = firstList(i); k < lastList(i); ++k) {
        const uint owner = listOf(k);
        const uvec2 list = lists[owner];
        for (uint element = list.x; element < list.x + list.y; ++element) {
            if (!(directions[element].w > 0.0)) continue;
            const uint all[4] = touchingOf(owner, contacts[element].other);
            for (uint m = 1u; m < 4u; ++m)
                for (uint l = 0u; l < m; ++l)
                    if (isAwake(all[m]) && isAwake(all[l])) join(all[m], all[l]);
        }
    }
}
