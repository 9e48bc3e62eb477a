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

struct Searched {
    uint index;
    ContactEdge edge;
    vec3 middle;
    vec3 a, ab;
    float way; // of the faster end in this substep [m]
};

float wayOf(uint e) { return step.h * length(speeds[e].xyz); }

Searched searchedOf(uint e) {
    const ContactEdge edge = edges[e];
    const vec3 a = positions[edge.a].xyz;
    return Searched(e, edge, middles[e].xyz, a, positions[edge.b].xyz - a, wayOf(e));
}

bool isApart(uint e) { return !(edges[e].radius + wayOf(e) <= push.most); } // as part_points has it

bool isExcluded(uint e, uint f) {
    uint low = excluded[e], high = excluded[e + 1u];
    const uint end = high;
    while (low < high) {
        const uint middle = (low + high) / 2u;
        if (excluded[middle] < f) low = middle + 1u;
        else high = middle;
    }
    return low < end && excluded[low] == f;
}

bool shareAnEnd(ContactEdge e, ContactEdge f) { return e.a == f.a || e.a == f.b || e.b == f.a || e.b == f.b; }

bool isNear(Searched one, uint f) {
    const ContactEdge edge = edges[f];
    if (f == one.index || edge.radius < 0.0) return false; // that, cut
    const vec3 d = one.middle - middles[f].xyz;
    const float more = push.margin + (one.way + wayOf(f)), outer = one.edge.radius + edge.radius + more;
    if (dot(d, d) >= outer * outer || (one.edge.isMoving | edge.isMoving) == 0u || shareAnEnd(one.edge, edge)) return false;
    const vec3 c = positions[edge.a].xyz;
    const float reach = thickness[one.index] + thickness[f] + more;
    return squaredBetween(one.a - c, one.ab, positions[edge.b].xyz - c) < reach * reach && !isExcluded(one.index, f);
}

void list(uint e, uint f) {
    const uint slot = atomicAdd(found[e], 1u);
    if (slot < push.capacity) candidates[slot * push.row + e] = f;
}

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

uint pointsIn(ivec3 first, ivec3 last, Frame frame) {
    uint sum = 0u;
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; x += 3) {
                const uint slot = slotOf(ivec3(x, y, z), frame);
                sum += starts[slot + uint(min(last.x - x + 1, 3))] - starts[slot];
            }
    return sum;
}

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
