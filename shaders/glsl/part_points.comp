#version 460
// Before faces look for points: those too wide or too fast for the grid are listed, in any order; of the others the widest
// says how far around itself a face must look. Likewise middles of edges. Lists are made again after it: it puts away what
// contacts remember.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "math.glsl"

layout(std430, binding = 0) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 1) readonly buffer Radii { float radii[]; }; // below 0 = touches no face
layout(std430, binding = 2) buffer Points { FacePoints points; };
layout(std430, binding = 3) writeonly buffer Apart { uint apart[]; };
layout(std140, binding = 4) uniform Step { StepParams step; };
layout(std430, binding = 5) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 6) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 7) readonly buffer Memory { vec4 memory[]; }; // t [m]; side and overlap
layout(std430, binding = 8) writeonly buffer Kept { vec4 kept[]; };
layout(std430, binding = 9) writeonly buffer KeptOthers { uint keptOthers[]; }; // the face or edge
layout(std430, binding = 10) writeonly buffer KeptLists { uvec2 keptLists[]; };
layout(push_constant) uniform Push { FaceFindPush push; };
#include "keep_list.glsl"

void main() {
    const uint i = itemIndex(push.points);
    keptLists[i] = keep(lists[i]);
    if (radii[i] < 0.0) return;
    const float size = sizeOf(radii[i], step.h, velocities[i].xyz);
    if (size <= push.most) atomicMax(points.widest, floatBitsToUint(size));
    else apart[atomicAdd(points.apart, 1u)] = i; // what is no number too
}
