#version 460
// Repositions skin vertices in cells that a cut has split (list_split_vertices), after skin_cells.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"
#include "lattice/kuhn.glsl"

#include "surface/skin_material.glsl"

#define HUNG_BINDING 0
#include "surface/hung_vertex.glsl"
#define MOVED_BINDING 7
#include "surface/moved_vertex.glsl"
layout(std430, binding = 8) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 9) readonly buffer Listed { uint listed[]; };
layout(std430, binding = 10) writeonly buffer Vertices { SkinVertex vertices[]; };

#define ALIVE(i) LINKS(i)
#define REST(i) HOME(i)
#include "surface/skin_place.glsl"

#include "surface/nearby.glsl"

void main() {
    const uint count = counts[SKIN_LISTS * push.run + SKIN_SPLIT], item = itemIndex(count);
    if (item >= count) return;
    const uint v = listed[push.first + item];
    const HungVertex vertex = hungAt(v);
    const vec4 to = MOVED(v);
    if (to.w >= VERTEX_MOVED) { // it moved onto a rim
        const SkinGrid grid = SkinGrid(push.rowStride, push.sliceStride, push.spacing, 0u);
        vertices[vertex.vertex].position.xyz = nearbyOf(vertex.anchor, to.xyz, to.xyz, grid).place;
        return;
    }
    const uint held = heldWith(vertex.cell, vertex.corner);
    if (held != 255u) vertices[vertex.vertex].position.xyz = placeOf(vertex, held);
}
