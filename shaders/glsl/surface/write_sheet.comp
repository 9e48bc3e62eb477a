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

void splitInThree() {
    vec2 middle = vec2(0.0);
    for (int n = 0; n < 3; ++n) middle += (vec2(cuts.edges[n].from) + hitOf(cuts.edges[n]) * vec2(cuts.edges[n].way)) / 3.0;
    for (int n = 0; n < 3; ++n) {
        const uint corner = addCorner(n), ahead = addPoint(n, n);
        const uint inside = addOn(n, middle - vec2(cornerAt(triangle.kind, n)));
        addQuad(corner, ahead, inside, addPoint((n + 2) % 3, n));
    }
}

// Splits off the corner between two dead edges.
void splitInTwo() {
    int off = 0;
    for (int n = 0; n < 3; ++n)
        if (cuts.edges[n].isAlive) off = (n + 2) % 3;
    const int ahead = (off + 1) % 3, behind = (off + 2) % 3;
    const uint corner = addCorner(off), first = addPoint(off, off);
    addTriangle(corner, first, addPoint(behind, off));
    const uint start = addPoint(off, ahead), low = addCorner(ahead), high = addCorner(behind);
    addQuad(start, low, high, addPoint(behind, behind));
}

void splitAtPoint() {
    int n = 0;
    while (cuts.edges[n].isAlive) ++n;
    const uint from = addCorner(n), point = addBetween(n), to = addCorner((n + 1) % 3);
    addQuad(point, to, addCorner((n + 2) % 3), from);
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
    if (cuts.dead == 3u) splitInThree();
    else if (cuts.dead == 2u) splitInTwo();
    else splitAtPoint();
}
