#version 460
// Opens a step with a blade: stores the position of every particle, and the largest displacement since the last
// blade.
#extension GL_GOOGLE_include_directive : require
#include "common/cut.glsl"

#include "common/fetched.glsl"
FETCHED_VEC4(0, Positions, positionAt)  // x + thetaHPrevious v
FETCHED_VEC4(1, Velocities, velocityAt) // [m/s]
FETCHED_VEC4(2, PlacesBefore, before)   // w = 0: no blade yet
#define POSITION(i) positionAt(i).xyz
#define VELOCITY(i) velocityAt(i).xyz
#define BEFORE(i) before(i)
layout(std140, binding = 3) uniform Step { StepParams step; };
layout(std430, binding = 4) writeonly buffer Places { vec4 places[]; }; // w = 1
layout(std430, binding = 5) buffer Work { CutWork work; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item;
    const vec3 x = POSITION(i) - step.thetaHPrevious * VELOCITY(i);
    places[i] = vec4(x, 1.0);
    const vec4 then = BEFORE(i);
    const uint way = then.w > 0.0 ? floatBitsToUint(distance(x, then.xyz)) : 0u;
    if (way > work.farthest) atomicMax(work.farthest, way); // integers in the order of the floats: none is negative
}
