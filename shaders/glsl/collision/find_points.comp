#version 460
// Contacts with faces, before the first pass: lists the points that a pair of theirs may touch in this substep, or that
// remember a contact. Most candidates touch nothing, and the narrow phase costs many times this test, also where it is
// skipped: a software device computes both sides of a branch. Pairs of all other points touch nothing.
#extension GL_GOOGLE_include_directive : require
#define RUNS_LISTED
#include "common/kernel.glsl"

#include "collision/near_faces.glsl"
layout(std430, binding = 4) readonly buffer Lists { uvec2 lists[]; };
#include "common/fetched.glsl"
FETCHED_VEC4(5, Memory, memoryAt)
#define MEMORY(k) memoryAt(k)
layout(std430, binding = 6) buffer Directions { vec4 directions[]; }; // n, depth [m]; 0 = does not touch
layout(std140, binding = 7) uniform Step { StepParams step; };
layout(push_constant) uniform Push { FacePush push; };
layout(constant_id = 1) const bool keepsRest = false; // pairs keep overlaps: all points are listed
layout(constant_id = 5) const bool hasZones = false; // the scene has impact zones; else bindings 8 to 10 are empty
layout(std430, binding = 8) writeonly buffer Finding { DispatchArguments finding[]; }; // of the search for points that pass
layout(std430, binding = 9) writeonly buffer Solving { DispatchArguments solving[]; };
layout(std430, binding = 10) writeonly buffer Meets { uint meeting[]; }; // by element, see meeting_marks.glsl
#define TOUCHED_BINDING 11
#define FIRST_TOUCHED TOUCHED_POINTS
#include "collision/touched.h"
#include "collision/touched.glsl"

// False only if a point and a face stay out of reach of each other in the whole substep: a plane square to the line from
// the face's center to the point keeps them apart.
bool mayTouch(uint i, uvec2 candidate) {
    const ContactFace face = faceAt(candidate.x);
    const vec3 x = PREDICTED(i).xyz, v = PREDICTED_VELOCITY(i).xyz;
    const vec3 a = x - PREDICTED(face.a).xyz, b = x - PREDICTED(face.b).xyz, c = x - PREDICTED(face.c).xyz;
    const vec3 d = a + b + c;
    const vec3 ways = step.h * vec3(dot(d, v - PREDICTED_VELOCITY(face.a).xyz), dot(d, v - PREDICTED_VELOCITY(face.b).xyz), dot(d, v - PREDICTED_VELOCITY(face.c).xyz));
    const vec3 gaps = vec3(dot(d, a), dot(d, b), dot(d, c)) - max(ways, vec3(0.0)); // times |d|, the least in the substep
    return !(min(gaps.x, min(gaps.y, gaps.z)) > 1.001 * abs(uintBitsToFloat(candidate.y)) * length(d));
}

bool mayTouchAny(uint i, uvec2 list) {
    bool may = keepsRest && list.y > 0u;
    for (uint element = list.x; element < list.x + list.y; ++element) may = may || MEMORY(element) != vec4(0.0) || mayTouch(i, CONTACT(element));
    return may;
}

// The first search for points that pass runs if one may; each solution and each other search runs if the pass before it has run or found any.
void planSearch() {
    if (gl_WorkGroupID.x != 0u || gl_LocalInvocationID.x != 0u) return;
    for (uint round = 0u; round < ZONE_ROUNDS; ++round) solving[round].groupsX = 0u;
    finding[ZONE_GROUPS].groupsX = gl_NumWorkGroups.x;
}

void main() {
    if (hasZones) planSearch();
    const uint i = itemIndex(push.count);
    const uvec2 list = lists[i];
    if (mayTouchAny(i, list)) {
        listTouched(TOUCHED_POINTS, i);
        return;
    }
    for (uint element = list.x; element < list.x + list.y; ++element) {
        if (directions[element].w != 0.0) directions[element] = vec4(0.0);
        if (hasZones) meeting[element] = 0u;
    }
}
