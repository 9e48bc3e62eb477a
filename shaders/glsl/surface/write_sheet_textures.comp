#version 460
// Texture coordinates of the pieces of a sheet's skin that write_sheet has written: linear in each triangle.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/texture_layout.h"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer Hits { LinkHits hits[]; };
layout(std430, binding = 2) readonly buffer Triangles { SheetTriangle triangles[]; };
layout(std430, binding = 3) readonly buffer Starts { SheetCounts starts[]; };
layout(std430, binding = 4) readonly buffer State { SheetState state; };
layout(std430, binding = 5) readonly buffer Textured { TexturedHalf textured[]; };
layout(std430, binding = 6) writeonly buffer Coordinates { vec2 coordinates[]; }; // by index of all skins
layout(push_constant) uniform Push { SheetPush push; };
#include "lattice/sheet_edges.glsl"
#include "surface/hit_at.glsl"
#include "surface/sheet_polygons.glsl"

TexturedHalf self;
vec2 points[12]; // of vertices

// At a place in the cell.
uint add(vec2 place) {
    const bool isSecond = (triangle.kind & 1u) != 0u;
    const vec3 weights = isSecond ? vec3(1.0 - place.x, place.y, place.x - place.y) : vec3(1.0 - place.y, place.y - place.x, place.x);
    points[next.vertices] = weights.x * vec2(self.at[0], self.at[1]) + weights.y * vec2(self.at[2], self.at[3])
                            + weights.z * vec2(self.at[4], self.at[5]);
    return next.vertices++;
}

uint addOn(int corner, vec2 way) { return add(vec2(cornerAt(triangle.kind, corner)) + way); }

uint addBetween(int n) { return add(vec2(cuts.edges[n].from) + hitOf(cuts.edges[n]) * vec2(cuts.edges[n].way)); }

void addTriangle(uint a, uint b, uint c) {
    const uint first = push.firstPiece + 3u * next.triangles++;
    const bool isTurned = (triangle.kind & 2u) != 0u;
    coordinates[first] = points[a];
    coordinates[first + 1u] = points[isTurned ? c : b];
    coordinates[first + 2u] = points[isTurned ? b : c];
}

void main() {
    const uint t = itemIndex(push.triangles);
    if (t >= push.triangles) return;
    triangle = triangles[t];
    cuts = cutsOf(triangle);
    if (cuts.dead == 0u || state.missing > 0u) return;
    self = textured[t];
    next = SheetCounts(starts[t].triangles, 0u);
    addPieces();
}
