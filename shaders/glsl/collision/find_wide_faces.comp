#version 460
// Compares every point with the few faces that are much larger than the others or have too many points around them.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define WEIGHT_BINDING 14
#define LINKS_BINDING 15
#define HEADINGS_BINDING 12
#include "collision/face_search.glsl"
#include "collision/face_points.h"

layout(std430, binding = 10) readonly buffer Large { uint large[]; };
layout(std430, binding = 11) readonly buffer Points { uint apart[]; }; // FACE_POINTS_...
layout(std430, binding = 13) buffer Status { StatusWords status; };

void main() {
    const uint i = itemIndex(push.points);
    if (RADIUS(i) < 0.0) return;
    const vec3 x = POSITION(i).xyz;
    const float size = RADIUS(i) + motionOf(i);
    const uint all = push.large + apart[FACE_POINTS_WIDE];
    if (all > FACE_MOST_WIDE) atomicMax(status.candidates, CONTACT_MOST_ROOM + 1u); // reported as overflow
    for (uint l = 0u; l < min(all, FACE_MOST_WIDE) && !isFull(); ++l) {
        const uint f = l < push.large ? large[l] : apart[FACE_POINTS_FIRST + push.points + push.searched + l - push.large];
        if (f == ~0u) continue; // removed by a cut
        const Searched face = searchedOf(f);
        const float reach = face.reach + size;
        if (!isInBox(face, x, reach) || !isNear(face, i, x, 0.0)) continue;
        listUnlessExcluded(face, i);
    }
}
