#version 460
// Counting sort, last pass: stores the particles slot by slot.
#extension GL_GOOGLE_include_directive : require
#define MAY_RUN_LISTED
#include "common/kernel.glsl"

#include "common/fetched.glsl"
FETCHED_VEC4(0, Positions, positionAt)
FETCHED_UVEC2(1, Places, placeAt) // slot and rank of each particle
#define POSITION(i) positionAt(i)
#define PLACE(i) placeAt(i)
layout(std430, binding = 2) readonly buffer Starts { uint starts[]; };
layout(std430, binding = 3) writeonly buffer Sorted { uvec4 sorted[]; }; // bits of the position; index
layout(push_constant) uniform Push { GridPush push; };

void main() {
    const uint i = itemIndex(push.count);
    const uvec2 place = PLACE(i);
    if (place.x != ~0u) sorted[starts[place.x] + place.y] = uvec4(floatBitsToUint(POSITION(i).xyz), i);
}
