#version 460
// Disables the block links of bodies that were cut, and enables them again when links were restored; a work group for
// each body. A block is broken if a link inside it is dead. A block link is alive if neither of its blocks is broken and
// no link of its direction that leaves one of them is dead. Blocks keep masks as nodes do (link_masks.glsl).
#extension GL_GOOGLE_include_directive : require
#define GROUP_SIZE LEVEL_GROUP
#include "common/kernel.glsl"
#include "lattice/link_masks.glsl"
#include "levels/level_group.glsl"

layout(std430, binding = 0) readonly buffer Ranges { LevelRange ranges[]; }; // push.levels for each body
layout(std430, binding = 1) readonly buffer Octants { uint octants[]; };     // by block: LEVEL_CHILDREN, by corner
layout(std430, binding = 2) readonly buffer NodeLinks { uint nodeLinks[]; };  // by slot: masks
layout(std430, binding = 3) readonly buffer WholeNodes { uint wholeNodes[]; }; // by slot: masks of the uncut body
layout(std430, binding = 4) readonly buffer WholeBlocks { uint wholeBlocks[]; }; // by block
layout(std430, binding = 5) readonly buffer Blocks { LevelBlock blocks[]; };
layout(std430, binding = 6) readonly buffer WholeLinks { LevelLink wholeLinks[]; };
layout(std430, binding = 7) coherent buffer Open { uint open[]; };   // by block: links that its own children allow, or BROKEN_BLOCK
layout(std430, binding = 8) coherent buffer Masks { uint masks[]; }; // by block: live links
layout(std430, binding = 9) writeonly buffer Links { LevelLink links[]; };
layout(push_constant) uniform Push { LevelCutPush push; };

uint deadLinks(uint child, bool isNode) {
    return isNode ? wholeNodes[child] & ~nodeLinks[child] : wholeBlocks[child] & ~masks[child];
}

void findOpen(uint b, bool hasNodes) {
    uint alive = wholeBlocks[b];
    for (int corner = 0; corner < LEVEL_CHILDREN; ++corner) {
        const uint child = octants[b * LEVEL_CHILDREN + corner];
        if (child == NO_BLOCK) continue;
        if (!hasNodes && open[child] == BROKEN_BLOCK) alive = BROKEN_BLOCK;
        for (uint dead = deadLinks(child, hasNodes); dead != 0u; dead &= dead - 1u) {
            const int bit = findLSB(dead);
            const ivec3 to = cornerOf(corner) + directionOf(bit);
            const bool isInside = all(greaterThanEqual(to, ivec3(0))) && all(lessThanEqual(to, ivec3(1)));
            if (isInside) alive = BROKEN_BLOCK;
            else if (alive != BROKEN_BLOCK) alive &= ~(1u << bit);
        }
    }
    open[b] = alive;
}

void writeLinks(uint b) {
    const LevelBlock block = blocks[b];
    uint alive = 0u, k = block.firstLink;
    for (uint whole = wholeBlocks[b]; whole != 0u; whole &= whole - 1u, ++k) {
        const int bit = findLSB(whole);
        LevelLink link = wholeLinks[k];
        const bool isAlive = (open[b] >> bit & open[link.other] >> (25 - bit) & 1u) != 0u;
        if (isAlive) alive |= 1u << bit;
        else link.stiffness = 0.0;
        links[k] = link;
    }
    masks[b] = alive;
}

void main() {
    const uint body = bodyOfGroup(), lane = laneOfGroup();
    for (uint l = 0u; l < push.levels; ++l) {
        const LevelRange range = ranges[body * push.levels + l];
        for (uint k = lane; k < range.count; k += LEVEL_GROUP) findOpen(range.first + k, l == 0u);
        waitForGroup();
        for (uint k = lane; k < range.count; k += LEVEL_GROUP) writeLinks(range.first + k);
        waitForGroup();
    }
}
