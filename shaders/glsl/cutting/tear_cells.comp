#version 460
// Tearing, last pass: cuts each of the most stretched cells along a plane, or line, across the direction of its
// largest stretch, starting where a cut has reached the cell's rim, else through its centre. Links that it crosses
// are cut as by a blade. VOXELS: for voxel bodies; else for sheets.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) buffer Links { uint links[]; };
layout(std430, binding = 1) buffer Hits { LinkHits hits[]; };
layout(std430, binding = 2) buffer Dirty { uint dirty[]; };
layout(std430, binding = 3) readonly buffer Strains { CellStrain strains[]; };
layout(std430, binding = 4) readonly buffer Found { uint found[]; };
layout(std430, binding = 5) readonly buffer Tears { TearCount tears; };
layout(push_constant) uniform Push { TearPush push; };
#ifdef VOXELS
#include "cutting/voxel_cells.glsl"
#define DIRECTION(strain) vec3(strain.x, strain.y, strain.z)
#else
#include "cutting/sheet_cells.glsl"
#define DIRECTION(strain) vec2(strain.x, strain.z)
#endif
#include "cutting/tears.glsl"
#include "cutting/hits.glsl"
#include "surface/hit_at.glsl"

#define MARKS_DIRTY
#include "lattice/dirty.glsl"

// True if two cells have a node in common.
bool areNeighbors(uint one, uint other) {
    const int way = int(other) - int(one);
    bool are = false;
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y) are = are || abs(way - y * int(push.rowStride) - z * int(push.sliceStride)) <= 1;
    return are;
}

// True if fewer cells precede it than may tear in a step, and none of its neighbors does: those would write links
// that it reads.
bool isFirst(uint cell) {
    uint before = 0u;
    for (uint other = 0u; other < tears.count && before < push.most; ++other)
        if (isBefore(found[other], cell)) before += areNeighbors(found[other], cell) ? push.most : 1u;
    return before < push.most;
}

// Height of a corner above the cut through `at`, along the direction of the largest stretch [cells].
float heightOf(int corner, Way at, Way along) { return dot(along, Way(nodeOf(corner)) - at) + 1e-4; }

bool isOnOneSide(Way at, Way along) {
    int above = 0;
    for (int k = 0; k < CORNERS; ++k) above += heightOf(k, at, along) >= 0.0 ? 1 : 0;
    return above == 0 || above == CORNERS;
}

// The mean of the points where cuts have reached the rim; the centre if there are none, or if the cut would miss the
// cell.
Way startOf(uint cell, Way along) {
    Way sum = Way(0.0);
    float cuts = 0.0;
    for (uint l = 0u; l < edgeLinks; ++l) {
        if (isAliveIn(cell, l)) continue;
        const ivec2 ends = endsOf(l);
        sum += mix(Way(nodeOf(ends.x)), Way(nodeOf(ends.y)), hitAt(slotOf(cell, ends.x), bitOfLink(l)));
        ++cuts;
    }
    const Way start = cuts > 0.0 ? sum / cuts : Way(0.5);
    return isOnOneSide(start, along) ? Way(0.5) : start;
}

void main() {
    const uint item = itemIndex(push.count);
    if (item >= min(tears.count, push.count)) return;
    const uint cell = found[item];
    if (!isFirst(cell)) return;
    const Way along = DIRECTION(strains[cell]), start = startOf(cell, along);
    for (uint l = 0u; l < cellLinks; ++l) {
        const ivec2 ends = endsOf(l);
        const float from = heightOf(ends.x, start, along), to = heightOf(ends.y, start, along);
        if ((from >= 0.0) == (to >= 0.0) || !isAliveIn(cell, l)) continue;
        const uint owner = slotOf(cell, ends.x), other = slotOf(cell, ends.y);
        const int bit = bitOfLink(l);
        atomicAnd(links[owner], ~(1u << bit));
        atomicAnd(links[other], ~(1u << 25 - bit));
        LinkHits hit = hits[owner];
        setHit(hit, bit, from / (from - to));
        hits[owner] = hit;
        markAround(owner);
    }
}
