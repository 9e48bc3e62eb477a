#version 460
// Counting sort, last pass: stores the particles slot by slot.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

#ifdef TEXELS
layout(binding = 0) uniform samplerBuffer positions;
layout(binding = 1) uniform usamplerBuffer places;
#define POSITION(i) texelFetch(positions, int(i))
#define PLACE(i) texelFetch(places, int(i)).xy
#else
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Places { uvec2 places[]; }; // slot and rank of each particle
#define POSITION(i) positions[i]
#define PLACE(i) places[i]
#endif
layout(std430, binding = 2) readonly buffer Starts { uint starts[]; };
layout(std430, binding = 3) writeonly buffer Sorted { uvec4 sorted[]; }; // bits of the position; index
layout(push_constant) uniform Push { GridPush push; };

void main() {
    const uint i = itemIndex(push.count);
    const uvec2 place = PLACE(i);
    if (place.x != ~0u) sorted[starts[place.x] + place.y] = uvec4(floatBitsToUint(POSITION(i).xyz), i);
}
