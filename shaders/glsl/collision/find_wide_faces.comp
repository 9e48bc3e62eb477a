#version 460
// Compares every point with the few faces that are much larger than the others or have too many points around them.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define WEIGHT_BINDING 14
#define LINKS_BINDING 15
#include "collision/face_search.glsl"

layout(std430, binding = 10) readonly buffer Large { uint large[]; };
layout(std430, binding = 11) readonly buffer Apart { uint apart[]; }; // from push.points on, wide faces
layout(std430, binding = 12) readonly buffer Points { FacePoints points; };
layout(std430, binding = 13) buffer Status { StatusWords status; };

void main() {
    const uint i = itemIndex(push.points);
    if (RADIUS(i) < 0.0) return;
    const vec3 x = POSITION(i).xyz;
    const float size = sizeOf(RADIUS(i), step.h, VELOCITY(i).xyz);
    const uint all = push.large + points.wide;
    if (all > FACE_MOST_WIDE) atomicMax(status.candidates, CONTACT_MOST_ROOM + 1u); // reported as overflow
    for (uint l = 0u; l < min(all, FACE_MOST_WIDE) && !isFull(); ++l) {
        const uint f = l < push.large ? large[l] : apart[push.points + l - push.large];
        if (f == ~0u) continue; // removed by a cut
        const Searched face = searchedOf(f);
        const float reach = face.reach + size;
        if (!isInBox(face, x, reach) || !isNear(face, i, x, 0.0)) continue;
        listUnlessExcluded(face, i);
    }
}
