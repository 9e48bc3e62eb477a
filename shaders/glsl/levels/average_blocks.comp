#version 460
// Places the blocks of level 1 at the means of their particles by mass.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/kernel.glsl"
#include "common/fetched.glsl"

FETCHED_VEC4(0, Positions, positionAt) // stored positions, by slot [m]
FETCHED_UVEC2(1, Children, childAt) // LevelChild
layout(std430, binding = 2) writeonly buffer BlockPositions { vec4 blockPositions[]; }; // [m]
layout(push_constant) uniform Push { LevelPush push; };

void main() {
    const uint b = itemIndex(push.count);
    if (b >= push.count) return;
    const uint first = b * LEVEL_CHILDREN;
    const vec3 x = positionAt(childAt(first).x).xyz;
    vec3 sum = vec3(0.0); // relative to the first child: weights sum to 1 but for rounding
    [[unroll]] for (uint c = 1u; c < LEVEL_CHILDREN; ++c) {
        const uvec2 child = childAt(first + c);
        sum += uintBitsToFloat(child.y) * (positionAt(child.x).xyz - x);
    }
    blockPositions[b] = vec4(x + sum, 0.0);
}
