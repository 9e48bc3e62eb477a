#version 460
// Computes the kick of each block of level 1: by its links, and that of its parent. The gather of the substep kicks the
// block's particles.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/fetched.glsl"

layout(std430, binding = 0) readonly buffer Blocks { LevelBlock blocks[]; };
FETCHED_UVEC4(1, Links, linkAt) // LevelLink
FETCHED_VEC4(2, BlockPositions, blockPositionAt)
layout(std430, binding = 3) buffer Kicks { vec4 kicks[]; }; // of all blocks [m/s]
layout(std140, binding = 4) uniform Step { StepParams step; };
layout(push_constant) uniform Push { LevelPush push; };

#define LINK(k) linkAt(k)
#define BLOCK_POSITION(b) blockPositionAt(b).xyz
#include "levels/levels.glsl"

void main() {
    const uint b = itemIndex(push.count);
    if (b >= push.count) return;
    const LevelBlock block = blocks[b];
    vec3 dv = kickOfLinks(block, BLOCK_POSITION(b), substepOf(push.isFirst != 0u));
    if (block.parent != NO_BLOCK) dv += kicks[block.parent].xyz;
    kicks[b] = vec4(dv, 0.0);
}
