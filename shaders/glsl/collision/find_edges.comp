#version 460
// Every edge searches for others near it, in the cells around it and among the edges outside of the grid, and lists
// each pair once, in any order: sort_lists and index_rows_by_owner sort. A pair is listed if its distance, and that of the
// balls around both edges, is below the reach, plus a margin, plus the approach of both in this substep or along headings.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/kernel.glsl"
#include "common/segments.glsl"
#include "collision/hash_grid.glsl"

#include "common/fetched.glsl"
FETCHED_VEC4(0, Positions, positionAt)
layout(std430, binding = 1) readonly buffer Edges { ContactEdge edges[]; };
TEXEL_TWIN(1, usamplerBuffer, edgeTexels);
FETCHED_VEC4(2, Speeds, speedAt)
FETCHED_FLOAT(3, Thickness, thicknessAt)
FETCHED_UVEC4(4, Sorted, sortedAt)
FETCHED_UINT(5, Starts, startAt)
FETCHED_UINT(6, Excluded, excludedAt) // first of each edge, then partners, sorted
#define POSITION(i) positionAt(i)
#define SPEED(e) speedAt(e)
#define THICKNESS(e) thicknessAt(e)
#define SORTED(k) sortedAt(k)
#define START(slot) startAt(slot)
#define EXCLUDED(k) excludedAt(k)
#include "collision/edge_at.glsl"
layout(std430, binding = 7) coherent volatile buffer Bounds { GridBounds bounds; };
layout(std430, binding = 8) readonly buffer Points { uint apart[]; }; // FACE_POINTS_...
FETCHED_VEC4(9, Headings, headingAt)
#define HEADING(i) headingAt(i).xyz
layout(std430, binding = 10) readonly buffer Middles { vec4 middles[]; };
layout(std430, binding = 11) buffer Chains { uint chains[]; }; // chains of owners
#define PAIRS_BINDING 12
layout(std430, binding = 13) buffer Status { StatusWords status; };
layout(std430, binding = 14) buffer LinkChains { uint linkChains[]; };
layout(std140, binding = 15) uniform Step { StepParams step; };
FETCHED_VEC4(16, Velocities, velocityAt)
#define VELOCITY(i) velocityAt(i).xyz
layout(push_constant) uniform Push { FaceFindPush push; };
#define FINDS_PAIRS
#define FINDS_ROWS
#define ENTRIES_OF_PAIR 1u
#include "collision/listed_pairs.glsl"

#include "collision/motion_classes.glsl"
float most = mostMotion();
#include "collision/near_edges.glsl"
#include "collision/grid_rows.glsl"
#include "collision/cell_points.glsl"

// The visits, of up to 32 from `from` on, in a capsule around the edge that it must test: bit v for visit from + v.
uint around(Searched one, float range, Rows rows, uint from, uint total) {
    const uint last = min(from + 32u, rows.all);
    const float perLength2 = 1.0 / max(dot(one.ab, one.ab), 1e-30);
    uint visits = 0u;
    for (uint visit = from; visit < last; ++visit) {
        const uvec4 other = SORTED(placeOf(rows, visit, total));
        const vec3 d = uintBitsToFloat(other.xyz) - one.a;
        const vec3 apart = d - clamp(dot(d, one.ab) * perLength2, 0.0, 1.0) * one.ab;
        visits |= uint(dot(apart, apart) < range * range && looksFor(one.index, other.w)) << visit - from;
    }
    return visits;
}

// The near ones of these visits.
uint nearOf(Searched one, uint visits, Rows rows, uint from, Frame frame, uint total) {
    uint near = 0u;
    for (; visits != 0u; visits &= visits - 1u) {
        const int bit = findLSB(visits);
        const uint visit = from + uint(bit);
        const uvec4 other = SORTED(placeOf(rows, visit, total));
        const vec3 middle = uintBitsToFloat(other.xyz);
        const ContactEdge edge = edgeAt(other.w);
        const float way = wayOf(other.w);
        if (isIn(rows, visit, cellOf(middle, frame)) && !isApart(edge, way) && isNear(one, other.w, edge, way, middle))
            near |= 1u << bit;
    }
    return near;
}

// Branches are what costs: a batch is measured first, and only the remaining edges are processed then.
void searchRows(Searched one, float range, Rows rows, Frame frame, uint total) {
    for (uint from = 0u; from < rows.all && !isFull(); from += 32u) {
        uint near = nearOf(one, around(one, range, rows, from, total), rows, from, frame, total);
        for (; near != 0u; near &= near - 1u) {
            const uint f = SORTED(placeOf(rows, from + uint(findLSB(near)), total)).w;
            if (!isExcluded(one.index, f)) list(one, f);
        }
    }
}

void searchGrid(Searched one, uint total) {
    const Frame frame = frameOf(bounds, push.cells);
    const vec3 top = vec3(valueOf(bounds.highX), valueOf(bounds.highY), valueOf(bounds.highZ)), size = abs(one.middle);
    const vec3 b = one.a + one.ab;
    // slightly larger because of rounding
    const float range = 1.01 * (one.thickness + one.way + uintBitsToFloat(apart[FACE_POINTS_WIDEST]) + push.margin) +
                        1e-6 * max(size.x, max(size.y, size.z));
    const vec3 low = max(min(one.a, b) - range, frame.low), high = min(max(one.a, b) + range, top);
    if (any(lessThan(high, low))) return;
    const ivec3 first = cellOf(low, frame), last = cellOf(high, frame);
    if (pointsIn(first, last, frame) > FACE_MOST_POINTS) atomicMax(status.candidates, CONTACT_MOST_ROOM + 1u); // reported as overflow
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; y += 3)
            for (int x = first.x; x <= last.x; x += 3)
                searchRows(one, range, rowsFrom(ivec3(x, y, z), last, frame), frame, total);
}

void main() {
    const uint e = itemIndex(push.points);
    const Searched one = searchedOf(e);
    if (one.edge.radius < 0.0) return;
    const uint total = START(push.cells);
    const bool standsApart = isApart(one.edge, one.way);
    if (total > 0u && !standsApart) searchGrid(one, total);
    if (apart[FACE_POINTS_APART] > FACE_MOST_POINTS) atomicMax(status.candidates, CONTACT_MOST_ROOM + 1u);
    for (uint k = 0u; k < min(apart[FACE_POINTS_APART], FACE_MOST_POINTS) && !isFull(); ++k) {
        const uint f = apart[FACE_POINTS_FIRST + k];
        // of two edges outside of the grid the first lists the pair
        if ((standsApart && f < e) || !isNear(one, f, edgeAt(f), wayOf(f), middles[f].xyz) || isExcluded(e, f)) continue;
        list(one, f);
    }
}
