#version 460
// Texture coordinates of the pieces of skin triangles that write_pieces has written: linear in each triangle, between
// those of its corners.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/kernel.glsl"
#include "common/texture_layout.h"
#include "lattice/link_masks.glsl"

layout(std430, binding = 0) readonly buffer Listed { uint listed[]; }; // the count, and then the items
layout(std430, binding = 1) readonly buffer Owned { uvec4 owned[]; };
layout(std430, binding = 2) readonly buffer Links { uint links[]; };
layout(std430, binding = 3) readonly buffer Prisms { SkinPrism prisms[]; };
#define HUNG_BINDING 4
#include "surface/hung_vertex.glsl"
layout(std430, binding = 5) readonly buffer Starts { uvec2 starts[]; };
layout(std430, binding = 6) readonly buffer State { SurfaceState state; };
layout(std430, binding = 7) readonly buffer Vertices { CutVertex vertices[]; };
#define MOVED_BINDING 8
#include "surface/moved_vertex.glsl"
layout(std430, binding = 9) readonly buffer Textured { TexturedPrism textured[]; };
layout(std430, binding = 10) readonly buffer Coordinates { vec2 coordinates[]; }; // by index of all skins
layout(std430, binding = 11) writeonly buffer CutCoordinates { vec2 cutCoordinates[]; };
layout(push_constant) uniform Push { PrismPush push; };

#include "surface/skin_prisms.glsl"
#include "surface/skin_points.glsl"
#include "surface/skin_rest.glsl"

SkinPrism prism;
uint self, first; // first: of the triangle, in coordinates[]

#include "surface/piece_triangles.glsl"

// The point on edge n.
vec2 onEdge(uint n) {
    const uint next = (n + 1u) % 3u;
    const vec3 start = restOf(prism.vertices[n]).xyz, way = restOf(prism.vertices[next]).xyz - start;
    const vec3 point = vertices[skinPoint(prism, self, n, true)].rest.xyz;
    const float share = clamp(dot(point - start, way) / max(dot(way, way), 1e-30), 0.0, 1.0);
    return mix(coordinates[first + n], coordinates[first + next], share);
}

vec2 pointAt(uint corner) {
    if (corner < 3u) return coordinates[first + corner];
    if (corner < firstCenter) return onEdge(corner % 3u);
    return (onEdge(0u) + onEdge(1u) + onEdge(2u)) / 3.0;
}

void main() {
    const uint item = itemIndex(listed[0]);
    if (item >= listed[0] || listed[1u + item] < push.first) return;
    self = listed[1u + item] - push.first;
    prism = prisms[self];
    const uint triangle = textured[self].triangle;
    if (triangle == NO_TEXTURE) return;
    first = 3u * triangle;
    addPieces();
    const uint next = state.points + 3u * starts[push.first + self].y;
    [[dont_unroll]] for (uint n = 0u; n < 3u * count; ++n) {
        const uint corner = noted[n / 3u] >> 4u * (n % 3u) & 15u;
        cutCoordinates[next + n] = pointAt(corner);
    }
}
