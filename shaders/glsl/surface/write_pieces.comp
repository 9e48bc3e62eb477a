#version 460
// The surface of a cut, sixth pass for skins of meshes: pieces of skin triangles, as write_outside does for faces of
// cells. Corners coincide with the vertices of the skin; points on its edges have the skin's normal at rest there.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/kernel.glsl"
#include "lattice/link_masks.glsl"

layout(std430, binding = 0) readonly buffer Listed { uint listed[]; }; // the count, and then the items
layout(std430, binding = 1) readonly buffer Owned { uvec4 owned[]; };
layout(std430, binding = 2) readonly buffer Links { uint links[]; };
layout(std430, binding = 3) readonly buffer Prisms { SkinPrism prisms[]; };
#define HUNG_BINDING 4
#include "surface/hung_vertex.glsl"
layout(std430, binding = 5) readonly buffer Starts { uvec2 starts[]; };
layout(std430, binding = 6) readonly buffer State { SurfaceState state; };
layout(std430, binding = 7) buffer Vertices { CutVertex vertices[]; };
layout(std430, binding = 8) writeonly buffer Indices { uint indices[]; };
#define MOVED_BINDING 9
#include "surface/moved_vertex.glsl"
layout(push_constant) uniform Push { PrismPush push; };

#include "surface/skin_prisms.glsl"
#include "surface/skin_points.glsl"
#include "surface/skin_rest.glsl"

uint next; // index of the first outer triangle
SkinPrism prism;
uint self;

#include "surface/piece_vertices.glsl"

#include "surface/piece_triangles.glsl"

void writeNoted() {
    [[dont_unroll]] for (uint corner = 0u; corner < 3u * count; ++corner) {
        const uint vertex = state.points + 3u * next + corner;
        vertices[vertex] = vertexAt(noted[corner / 3u] >> 4u * (corner % 3u) & 15u);
        indices[3u * (state.inside + next) + corner] = vertex;
    }
}

void main() {
    const uint item = itemIndex(listed[0]);
    if (item >= listed[0] || listed[1u + item] < push.first) return;
    self = listed[1u + item] - push.first;
    prism = prisms[self];
    next = starts[push.first + self].y;
    addPieces();
    writeNoted();
}
