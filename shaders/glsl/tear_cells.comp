#version 460
// Tearing, last pass: through each of the most stretched cells goes a straight cut across the direction in which it is stretched most,
// from where one has already reached the cell's rim, else through its middle. Links that the cut crosses die, as
// under a blade.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) buffer Links { uint links[]; };
layout(std430, binding = 1) buffer Hits { LinkHits hits[]; };
layout(std430, binding = 2) writeonly buffer Dirty { uint dirty[]; };
layout(std430, binding = 3) readonly buffer Strains { CellStrain strains[]; };
layout(std430, binding = 4) readonly buffer Found { uint found[]; };
layout(std430, binding = 5) readonly buffer Tears { TearCount tears; };
layout(push_constant) uniform Push { TearPush push; };
#include "sheet_cells.glsl"
#include "tears.glsl"
#include "hits.glsl"
#include "hit_at.glsl"

uint wordOf(int slot) { return uint(clamp(slot - int(push.first), 0, int(push.count) - 1) + int(push.first)) >> 5; }

// As cut_links does.
void markAround(uint i) {
    for (int z = -1; z <= 1; ++z) {
        const int row = int(i) + z * int(push.sliceStride);
        dirty[wordOf(row - 1)] = 1u;
        dirty[wordOf(row + 1)] = 1u;
    }
}

// Whether fewer than may tear in a step come before it.
bool isAmongFirst(uint cell) {
    uint before = 0u;
    for (uint other = 0u; other < tears.count && before < push.most; ++other) before += isBefore(found[other], cell) ? 1u : 0u;
    return before < push.most;
}

// Of corners, along the direction of the greatest stretch from the cut through `at` [cells].
vec4 heightsFrom(vec2 at, vec2 along) {
    vec4 heights;
    for (int k = 0; k < 4; ++k) heights[k] = dot(along, vec2(nodeOf(k)) - at) + 1e-4;
    return heights;
}

bool isOnOneSide(vec4 heights) { return all(lessThan(heights, vec4(0.0))) || all(greaterThanEqual(heights, vec4(0.0))); }

// Where cuts have reached the rim; the middle where none has.
vec2 startOf(uint cell) {
    vec2 sum = vec2(0.0);
    float cuts = 0.0;
    for (uint l = 0u; l < 4u; ++l) {
        if (isAliveIn(cell, l)) continue;
        const ivec2 ends = endsOf(l);
        sum += mix(vec2(nodeOf(ends.x)), vec2(nodeOf(ends.y)), hitAt(slotOf(cell, ends.x), bitOfLink(l)));
        ++cuts;
    }
    return cuts > 0.0 ? sum / cuts : vec2(0.5);
}

void main() {
    const uint item = itemIndex(push.count);
    if (item >= min(tears.count, push.count)) return;
    const uint cell = found[item];
    if (!isAmongFirst(cell)) return;
    const vec2 along = vec2(strains[cell].x, strains[cell].z);
    vec4 heights = heightsFrom(startOf(cell), along);
    if (isOnOneSide(heights)) heights = heightsFrom(vec2(0.5), along);
    for (uint l = 0u; l < cellLinks; ++l) {
        const ivec2 ends = endsOf(l);
        if ((heights[ends.x] >= 0.0) == (heights[ends.y] >= 0.0) || !isAliveIn(cell, l)) continue;
        const uint owner = slotOf(cell, ends.x), other = slotOf(cell, ends.y);
        const int bit = bitOfLink(l);
        atomicAnd(links[owner], ~(1u << bit));
        atomicAnd(links[other], ~(1u << 25 - bit));
        storeHit(owner, bit, heights[ends.x] / (heights[ends.x] - heights[ends.y]));
        markAround(owner);
    }
}
