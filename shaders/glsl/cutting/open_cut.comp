#version 460
// Opens a step with a blade: stores the position of every particle, and the largest displacement since the last
// blade.
#extension GL_GOOGLE_include_directive : require
#include "common/cut.glsl"

#ifdef TEXELS
layout(binding = 0) uniform samplerBuffer positions;
layout(binding = 1) uniform samplerBuffer velocities;
layout(binding = 2) uniform samplerBuffer before;
#define POSITION(i) texelFetch(positions, int(i)).xyz
#define VELOCITY(i) texelFetch(velocities, int(i)).xyz
#define BEFORE(i) texelFetch(before, int(i))
#else
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };   // x + thetaHPrevious v
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; }; // [m/s]
layout(std430, binding = 2) readonly buffer PlacesBefore { vec4 before[]; };   // w = 0: no blade yet
#define POSITION(i) positions[i].xyz
#define VELOCITY(i) velocities[i].xyz
#define BEFORE(i) before[i]
#endif
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
