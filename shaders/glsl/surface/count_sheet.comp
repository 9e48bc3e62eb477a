#version 460
// Pieces of the skin of a sheet, first pass: counts the triangles and vertices that replace each triangle reached by
// a cut. A single dead edge only splits the triangle at the point at which the next triangle may end.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer Triangles { SheetTriangle triangles[]; };
layout(std430, binding = 2) writeonly buffer Counts { SheetCounts counts[]; };
layout(push_constant) uniform Push { SheetPush push; };
#include "lattice/sheet_edges.glsl"

void main() {
    const uint t = itemIndex(push.triangles);
    if (t >= push.triangles) return;
    const uint dead = cutsOf(triangles[t]).dead;
    counts[t] = dead == 0u ? SheetCounts(0u, 0u) : dead == 1u ? SheetCounts(2u, 4u) : dead == 2u ? SheetCounts(3u, 7u) : SheetCounts(6u, 12u);
}
