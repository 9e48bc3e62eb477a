#version 460
// Runs before faces search for points, or edges for edges: lists the points too wide or too fast for the grid, in any
// order, and finds the largest size among all others, which bounds the search range. For edges the points are their
// midpoints. Saves contact memory and empties the lists, which are rebuilt after this pass.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/math.glsl"

layout(std430, binding = 0) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 1) readonly buffer Radii { float radii[]; }; // below 0 = touches no face
layout(std430, binding = 2) buffer Points { uint apart[]; }; // FACE_POINTS_...
layout(constant_id = 3) const bool limitsMotion = false; // motions are counted
layout(constant_id = 2) const bool hasHeadings = false; // false: `velocities` have their share of them
layout(std430, binding = 3) readonly buffer Headings { vec4 headings[]; };
layout(std430, binding = 11) readonly buffer Bounds { GridBounds bounds; };
layout(std140, binding = 4) uniform Step { StepParams step; };
layout(std430, binding = 5) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 6) buffer Lists { uvec2 lists[]; };
layout(std430, binding = 7) readonly buffer Memory { vec4 memory[]; }; // slip [m]; w: side and overlap
layout(std430, binding = 8) writeonly buffer Kept { vec4 kept[]; };
layout(std430, binding = 9) writeonly buffer KeptOthers { uint keptOthers[]; }; // index of the face or edge
layout(std430, binding = 10) writeonly buffer KeptLists { uvec2 keptLists[]; };
layout(std430, binding = 12) writeonly buffer LinkLists { uvec2 linkLists[]; };
layout(push_constant) uniform Push { FaceFindPush push; };
#include "collision/keep_list.glsl"
#include "collision/motion_classes.glsl"
#include "collision/motion_of.glsl"

void main() {
    const uint i = itemIndex(push.points);
    keptLists[i] = keep(lists[i]);
    lists[i] = uvec2(0u); // sort_lists and index_rows_by_owner visit those of found pairs alone
    for (uint f = i; f < push.moving; f += push.points) linkLists[f] = uvec2(0u);
    if (radii[i] < 0.0) return;
    const float motion = motionOf(velocities[i].xyz, hasHeadings ? headings[i] : vec4(0.0), bounds.horizon);
    const float size = radii[i] + motion;
    if (size <= push.most && (!limitsMotion || motion <= mostMotion())) atomicMax(apart[FACE_POINTS_WIDEST], floatBitsToUint(size));
    else apart[FACE_POINTS_FIRST + atomicAdd(apart[FACE_POINTS_APART], 1u)] = i; // also if the size is NaN
}
