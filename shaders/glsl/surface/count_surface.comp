#version 460
// The surface of a cut, third pass: counts the points of a slot, and the inner and outer triangles of the cell above
// it. write_inside and write_outside create them with the same code.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"
#include "lattice/kuhn.glsl"
#include "surface/cut_points.glsl"

layout(std430, binding = 0) readonly buffer Complex { uint complex[]; };
layout(std430, binding = 1) readonly buffer ListedCounts { uint listedCounts[]; };
layout(std430, binding = 2) readonly buffer Partitions { uint partitions[]; };
layout(std430, binding = 3) readonly buffer Owned { uvec4 owned[]; };
layout(std430, binding = 4) writeonly buffer Counts { SurfaceCounts counts[]; };
layout(std430, binding = 5) readonly buffer Links { uint links[]; };
layout(std430, binding = 6) readonly buffer Listed { uint listed[]; };
#include "common/listed_slot.glsl"

uint triangles = 0u;
void triangle(uvec2 a, uvec2 b, uvec2 c) { ++triangles; }
void writeNoted() {}
bool hasPoint(uvec2 point) { return hasBit(owned[point.x], point.y & ~1u); }
void setNormal(uint axis, bool isHigh) {}
#include "surface/cut_inside.glsl"
#include "surface/cut_outside.glsl"

// True if the corners of a cell own any point: triangles in the cell, and on its low faces, have only such points as
// corners.
bool hasPoints(uint cell) {
    uint all = 0u;
    [[dont_unroll]] for (uint k = 0u; k < 8u; ++k) {
        const uvec4 own = owned[slotOf(cell, k)];
        all |= own.x | own.y | own.z;
    }
    return all != 0u;
}

void main() {
    const uint i = listedSlot();
    if (i == NO_SLOT) return;
    if (!hasPoints(i)) {
        counts[i] = SurfaceCounts(0u, 0u);
        return;
    }
    addInside(i);
    const uint inside = triangles;
    const uint pieces = addOutside(i);
    counts[i] = SurfaceCounts(countOf(owned[i]) | inside << 8 | triangles - inside << 16, pieces);
}
