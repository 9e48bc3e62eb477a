#version 460
// Finds out whether a particle is farther from where it was when the grid was built than lists bear. Where one is, all
// that remains is decided by plan_grid; most particles never touch the shared word.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

#ifdef TEXELS
layout(binding = 0) uniform samplerBuffer positions;
layout(binding = 1) uniform samplerBuffer detected;
#define POSITION(i) texelFetch(positions, int(i))
#define DETECTED(i) texelFetch(detected, int(i))
#else
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Detected { vec4 detected[]; }; // where they were; w unused
#define POSITION(i) positions[i]
#define DETECTED(i) detected[i]
#endif
layout(std430, binding = 2) buffer Bounds { GridBounds bounds; };
layout(push_constant) uniform Push { GridPush push; };

void main() {
    const uint i = itemIndex(push.count);
    const vec3 way = POSITION(i).xyz - DETECTED(i).xyz;
    const float squared = dot(way, way);
    if (!(squared <= push.slack * push.slack)) // what is no number has gone far
        atomicMax(bounds.moved, floatBitsToUint(min(sqrt(squared), 1e30)));
}
