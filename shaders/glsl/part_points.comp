#version 460
// Before faces look for points: those too wide or too fast for the grid are listed, in any order; of the others the widest
// says how far around itself a face must look. Likewise middles of edges.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "math.glsl"

layout(std430, binding = 0) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 1) readonly buffer Radii { float radii[]; }; // below 0 = touches no face
layout(std430, binding = 2) buffer Points { FacePoints points; };
layout(std430, binding = 3) writeonly buffer Apart { uint apart[]; };
layout(std140, binding = 4) uniform Step { StepParams step; };
layout(push_constant) uniform Push { FaceFindPush push; };

void main() {
    const uint i = itemIndex(push.points);
    if (radii[i] < 0.0) return;
    const float size = sizeOf(radii[i], step.h, velocities[i].xyz);
    if (size <= push.most) atomicMax(points.widest, floatBitsToUint(size));
    else apart[atomicAdd(points.apart, 1u)] = i; // what is no number too
}
