#version 460
// Every edge looks for others near it, in the cells around it and among those that stand apart, and lists them, in any order:
// sort_contacts sorts. A pair is listed where the two are nearer than touching, a margin, and what both move in this substep,
// and their balls likewise; both list it.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "segments.glsl"
#include "hash_grid.glsl"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Edges { ContactEdge edges[]; };
layout(std430, binding = 2) readonly buffer Middles { vec4 middles[]; };
layout(std430, binding = 3) readonly buffer Speeds { vec4 speeds[]; };
layout(std430, binding = 4) readonly buffer Thickness { float thickness[]; };
layout(std430, binding = 5) readonly buffer Sorted { uvec4 sorted[]; };
layout(std430, binding = 6) readonly buffer Starts { uint starts[]; };
layout(std140, binding = 7) uniform Bounds { GridBounds bounds; };
layout(std430, binding = 8) readonly buffer Points { FacePoints points; };
layout(std430, binding = 9) readonly buffer Apart { uint apart[]; };
layout(std430, binding = 10) readonly buffer Excluded { uint excluded[]; }; // first of each edge, then partners, sorted
layout(std430, binding = 11) buffer Found { uint found[]; };               // edges near each, listed or not; 0 at first
layout(std430, binding = 12) writeonly buffer Candidates { uint candidates[]; };
layout(std430, binding = 13) writeonly buffer Ends { vec4 ends[]; };
layout(std430, binding = 14) buffer Status { StatusWords status; };
layout(std140, binding = 15) uniform Step { StepParams step; };
layout(push_constant) uniform Push { FaceFindPush push; };

#include "near_edges.glsl"

// Three cells in a row from `cell` on, but none beyond `last` in x.
void searchCells(Searched one, ivec3 cell, int last, Frame frame, uint total, inout uint n) {
    const uint slot = slotOf(cell, frame), width = uint(min(last - cell.x + 1, 3)), end = starts[slot + width];
    for (uint k = starts[slot]; k < end && n <= push.limit; ++k) {
        const uvec4 other = sorted[k < total ? k : k - total];
        const ivec3 home = cellOf(uintBitsToFloat(other.xyz), frame);
        if (home.yz != cell.yz || uint(home.x - cell.x) >= width || isApart(other.w) || !isNear(one, other.w)) continue;
        list(one.index, other.w);
        ++n;
    }
}

#include "cell_points.glsl"

void searchGrid(Searched one, uint total) {
    const Frame frame = frameOf(bounds, push.cells, push.edge);
    const vec3 top = vec3(valueOf(bounds.highX), valueOf(bounds.highY), valueOf(bounds.highZ)), size = abs(one.middle);
    // a little more: rounding
    const float range = 1.01 * (one.edge.radius + one.way + uintBitsToFloat(points.widest) + push.margin) +
                        1e-6 * max(size.x, max(size.y, size.z));
    const vec3 low = max(one.middle - range, frame.low), high = min(one.middle + range, top);
    if (any(lessThan(high, low))) return;
    const ivec3 first = cellOf(low, frame), last = cellOf(high, frame);
    if (pointsIn(first, last, frame) > FACE_MOST_POINTS) atomicMax(status.candidates, push.limit + 1u); // said, not lost
    uint n = 0u;
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; x += 3) searchCells(one, ivec3(x, y, z), last.x, frame, total, n);
}

void main() {
    const uint e = itemIndex(push.points);
    const Searched one = searchedOf(e);
    ends[2u * e] = vec4(one.a, 0.0);
    ends[2u * e + 1u] = vec4(positions[one.edge.b].xyz, 0.0);
    if (one.edge.radius < 0.0) return;
    const uint total = starts[push.cells];
    const bool standsApart = isApart(e);
    if (total > 0u && !standsApart) searchGrid(one, total);
    if (points.apart > FACE_MOST_POINTS) atomicMax(status.candidates, push.limit + 1u);
    for (uint k = 0u; k < min(points.apart, FACE_MOST_POINTS); ++k) {
        const uint f = apart[k];
        if ((standsApart && f < e) || !isNear(one, f)) continue; // of two apart the first lists both
        list(e, f);
        list(f, e);
    }
}
