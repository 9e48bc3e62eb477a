#version 460
// Pieces of the skin of a sheet, last pass: collapses triangles reached by a cut to a point in the skin's own
// indices, and writes their pieces after these. A point on a dead edge has a copy at either end, bound to that end
// alone, unless the triangle on the other side still connects the two: then it lies between them, which closes the
// end of a cut. Both triangles compute the same bits, from the edge's owner.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer Hits { LinkHits hits[]; };
layout(std430, binding = 2) readonly buffer Triangles { SheetTriangle triangles[]; };
layout(std430, binding = 3) readonly buffer Starts { SheetCounts starts[]; };
layout(std430, binding = 4) readonly buffer State { SheetState state; };
layout(std430, binding = 5) readonly buffer AllIndices { uint allIndices[]; }; // indices of the uncut skins
layout(std430, binding = 6) writeonly buffer Indices { uint indices[]; };
layout(std430, binding = 7) writeonly buffer Vertices { SheetVertex vertices[]; };
layout(push_constant) uniform Push { SheetPush push; };
#include "lattice/sheet_edges.glsl"
#include "surface/hit_at.glsl"
#include "surface/sheet_polygons.glsl"

float turn() { return (triangle.kind & 2u) == 0u ? 1.0 : -1.0; }

uint add(SheetVertex vertex) {
    vertices[next.vertices] = vertex;
    return push.firstVertex + next.vertices++;
}

uint addOn(int corner, vec2 way) {
    const uint slot = slotAt(triangle.slot, cornerAt(triangle.kind, corner));
    return add(SheetVertex(slot, slot, 0.0, way.x, way.y, turn()));
}

uint addBetween(int n) {
    const Edge edge = cuts.edges[n];
    return add(SheetVertex(edge.owner, edge.other, hitOf(edge), 0.0, 0.0, turn()));
}

void addTriangle(uint a, uint b, uint c) {
    const uint first = push.firstPiece + 3u * next.triangles++;
    const bool isTurned = (triangle.kind & 2u) != 0u;
    indices[first] = a;
    indices[first + 1u] = isTurned ? c : b;
    indices[first + 2u] = isTurned ? b : c;
}

void main() {
    const uint t = itemIndex(push.triangles);
    if (t >= push.triangles) return;
    triangle = triangles[t];
    cuts = cutsOf(triangle);
    next = starts[t];
    const bool isHidden = cuts.dead > 0u && state.missing == 0u;
    for (uint n = 0u; n < 3u; ++n) {
        const uint index = push.firstIndex + 3u * t;
        indices[index + n] = allIndices[index + (isHidden ? 0u : n)];
    }
    if (!isHidden) return;
    addPieces();
}
