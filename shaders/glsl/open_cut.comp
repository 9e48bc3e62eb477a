#version 460
// Opens a step with a blade: puts down where every particle is, which links live (what an undone step goes back to), and how far
// anything has moved since the last blade.
#extension GL_GOOGLE_include_directive : require
#include "cut.glsl"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };   // x + thetaHPrevious v
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; }; // [m/s]
layout(std140, binding = 2) uniform Step { StepParams step; };
layout(std430, binding = 3) readonly buffer Links { uint links[]; };
layout(std430, binding = 4) writeonly buffer SavedLinks { uint savedLinks[]; };
layout(std430, binding = 5) writeonly buffer Places { vec4 places[]; };      // w = 1
layout(std430, binding = 6) readonly buffer PlacesBefore { vec4 before[]; }; // w = 0: no blade yet
layout(std430, binding = 7) buffer Work { CutWork work; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item;
    const vec3 x = positions[i].xyz - step.thetaHPrevious * velocities[i].xyz;
    savedLinks[i] = links[i];
    places[i] = vec4(x, 1.0);
    const uint way = before[i].w > 0.0 ? floatBitsToUint(distance(x, before[i].xyz)) : 0u;
    if (way > work.farthest) atomicMax(work.farthest, way); // whole numbers order like the floats: none is negative
}
