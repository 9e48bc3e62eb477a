#version 460
// Runs before faces search for points, or edges for edges: lists the points too wide or too fast for the grid, in any
// order, and finds the largest size among all others, which bounds the search range. For edges the points are their
// midpoints. Saves contact memory, since the lists are rebuilt after this pass.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/math.glsl"

layout(std430, binding = 0) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 1) readonly buffer Radii { float radii[]; }; // below 0 = touches no face
layout(std430, binding = 2) buffer Points { FacePoints points; };
layout(std430, binding = 3) writeonly buffer Apart { uint apart[]; };
layout(std140, binding = 4) uniform Step { StepParams step; };
layout(std430, binding = 5) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 6) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 7) readonly buffer Memory { vec4 memory[]; }; // slip [m]; w: side and overlap
layout(std430, binding = 8) writeonly buffer Kept { vec4 kept[]; };
layout(std430, binding = 9) writeonly buffer KeptOthers { uint keptOthers[]; }; // index of the face or edge
layout(std430, binding = 10) writeonly buffer KeptLists { uvec2 keptLists[]; };
layout(push_constant) uniform Push { FaceFindPush push; };
#include "collision/keep_list.glsl"

void main() {
    const uint i = itemIndex(push.points);
    keptLists[i] = keep(lists[i]);
    if (radii[i] < 0.0) return;
    const float size = sizeOf(radii[i], step.h, velocities[i].xyz);
    if (size <= push.most) atomicMax(points.widest, floatBitsToUint(size));
    else apart[atomicAdd(points.apart, 1u)] = i; // also if the size is NaN
}
