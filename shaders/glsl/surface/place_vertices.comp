#version 460
// Positions of the listed vertices of a skin in the state at the start of the step, computed once for all prisms
// around each.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"
#include "lattice/kuhn.glsl"

#include "common/blade_places.glsl"
#include "surface/before_cut.glsl"
#define HUNG_BINDING 6
#include "surface/hung_vertex.glsl"
layout(std430, binding = 7) readonly buffer Partitions { uint partitions[]; }; // before this step
layout(std430, binding = 8) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 9) readonly buffer Listed { uint listed[]; };
layout(std430, binding = 10) buffer Placed { PlacedVertex placed[]; };
layout(std430, binding = 11) readonly buffer Moved { vec4 moved[]; };

#include "surface/around.glsl"

// The corners of cells that were whole are all connected.
vec3 placeNow(uint v, HungVertex vertex) {
    const vec4 to = moved[v];
    if (to.w == VERTEX_OLD || to.w >= VERTEX_MOVED && blade.isCarried == 0u) // on the rim of an earlier stroke
        return placeIn(aroundOf(vertex.anchor), gradientAt(vertex.anchor), to.xyz);
    uint held = 255u;
    if (partitions[vertex.cell] != 0u) held = heldWith(vertex.cell, vertex.corner);
    return placeOf(vertex, held);
}

void main() {
    readBlade();
    const uint count = counts[SKIN_LISTS * push.run + SKIN_VERTICES], item = itemIndex(count);
    if (item >= count) return;
    const uint v = listed[push.first + item];
    const HungVertex vertex = hungAt(v);
    const uint anchor = vertex.anchor;
    const vec3 x = placeNow(v, vertex);
    const vec4 last = placed[v].now;
    // a vertex that has just come near moves like its particle: no test has used it before
    const bool isOnItsWay = blade.isCarried != 0u && last.w > 0.0;
    placed[v] = PlacedVertex(vec4(isOnItsWay ? last.xyz : x + placeBefore(anchor) - PLACE(anchor), isOnItsWay ? 1.0 : 0.0), vec4(x, 1.0));
}
