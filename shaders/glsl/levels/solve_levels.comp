#version 460
// Levels above the first, a work group for each body: places their blocks, and computes the kick of each from the
// coarsest level down. A kick contains that of the parent.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define GROUP_SIZE LEVEL_GROUP
#include "common/kernel.glsl"
#include "common/fetched.glsl"

layout(std430, binding = 0) readonly buffer Ranges { LevelRange ranges[]; }; // push.count, the levels, for each body
layout(std430, binding = 1) readonly buffer Blocks { LevelBlock blocks[]; };
FETCHED_UVEC2(2, Children, childAt) // LevelChild
FETCHED_UVEC4(3, Links, linkAt)     // LevelLink
layout(std430, binding = 4) coherent buffer BlockPositions { vec4 positions[]; }; // of all blocks [m]
layout(std430, binding = 5) coherent buffer Kicks { vec4 kicks[]; };              // of all blocks [m/s]
layout(std140, binding = 6) uniform Step { StepParams step; };
layout(push_constant) uniform Push { LevelPush push; };

#define LINK(k) linkAt(k)
#define BLOCK_POSITION(b) positions[b].xyz
#define CHILD_POSITION(b) positions[b].xyz
#include "levels/level_group.glsl"
#include "levels/levels.glsl"
#include "levels/place_block.glsl"

void kick(uint b, Substep substep) {
    const LevelBlock block = blocks[b];
    vec3 dv = kickOfLinks(block, positions[b].xyz, substep);
    if (block.parent != NO_BLOCK) dv += kicks[block.parent].xyz;
    kicks[b] = vec4(dv, 0.0);
}

void main() {
    const uint body = bodyOfGroup(), lane = laneOfGroup(), levels = push.count;
    const Substep substep = substepOf(push.isFirst != 0u);
    for (uint l = 1u; l < levels; ++l) {
        const LevelRange range = ranges[body * levels + l];
        for (uint k = lane; k < range.count; k += LEVEL_GROUP) positions[range.first + k] = vec4(placeOf(range.first + k), 0.0);
        waitForGroup();
    }
    for (uint l = levels; --l > 0u;) {
        const LevelRange range = ranges[body * levels + l];
        for (uint k = lane; k < range.count; k += LEVEL_GROUP) kick(range.first + k, substep);
        waitForGroup();
    }
}
