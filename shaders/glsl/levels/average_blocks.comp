#version 460
// Places the blocks of level 1 at the weighted means of their particles.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/kernel.glsl"
#include "common/fetched.glsl"

FETCHED_VEC4(0, Positions, positionAt) // stored positions, by slot [m]
FETCHED_UVEC2(1, Children, childAt)    // LevelChild
layout(std430, binding = 2) writeonly buffer BlockPositions { vec4 blockPositions[]; }; // [m]
layout(push_constant) uniform Push { CountPush push; };

#define CHILD_POSITION(i) positionAt(i).xyz
#include "levels/place_block.glsl"

void main() {
    const uint b = itemIndex(push.count);
    if (b < push.count) blockPositions[b] = vec4(placeOf(b), 0.0);
}
