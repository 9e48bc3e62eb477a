#version 460
// The surface of a cut, fourth pass for skins of meshes: the points on the edges of a skin and at the centres of its
// triangles, with the anchors that each is bound to, as write_points does for slots.
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
layout(std430, binding = 5) readonly buffer SkinHits { uint skinHits[]; }; // (intersect_skin_edges)
layout(std430, binding = 6) writeonly buffer Vertices { CutVertex vertices[]; };
#define MOVED_BINDING 7
#include "surface/moved_vertex.glsl"
layout(push_constant) uniform Push { PrismPush push; };

#include "surface/skin_prisms.glsl"
#include "surface/skin_points.glsl"
#include "surface/skin_rest.glsl"
#include "surface/rim_share.glsl"

// Position of the cut along edge n.
float shareOf(SkinPrism prism, uint self, uint n) {
    const SkinEdge edge = edgeOf(prism, self, n);
    const uint word = skinHits[edge.prism];
    const float start = MOVED(prism.vertices[n]).w, end = MOVED(prism.vertices[(n + 1u) % 3u]).w;
    uint share = bitfieldExtract(word, int(8u * edge.edge), 8);
    if ((word & partedBit(edge.edge)) == 0u) share = rimShare(edge.isReversed ? end : start, edge.isReversed ? start : end, share);
    return float(edge.isReversed ? 255u - share : share) / 255.0;
}

vec4 edgePlace(SkinPrism prism, uint self, uint n) {
    const vec4 from = restOf(prism.vertices[n]), to = restOf(prism.vertices[(n + 1u) % 3u]);
    return vec4(mix(from.xyz, to.xyz, shareOf(prism, self, n)), from.w);
}

void write(uint at, vec4 place, SkinPrism prism, uint a, uint b, float share) {
    const uint corners[4] = uint[4](prism.anchors[a], prism.anchors[b], prism.vertices[a], prism.vertices[b]);
    vertices[at] = CutVertex(place, vec4(1.0 - share, share, 0.0, 0.0), corners, int[3](0, 0, 0), SURFACE_RIM | at);
}

void main() {
    const uint item = itemIndex(listed[0]);
    if (item >= listed[0] || listed[1u + item] < push.first) return;
    const uint self = listed[1u + item] - push.first;
    const SkinPrism prism = prisms[self];
    const uint points = owned[push.first + self].x;
    [[dont_unroll]] for (uint n = 0u; n < 3u; ++n) {
        if ((points >> 2u * n & 1u) == 0u) continue;
        const vec4 place = edgePlace(prism, self, n);
        const uint next = (n + 1u) % 3u;
        const bool isOne = (points >> 6u + n & 1u) != 0u;
        write(skinPoint(prism, self, n, true), place, prism, n, next, isOne ? shareOf(prism, self, n) : 0.0);
        if (!isOne) write(skinPoint(prism, self, n, false), place, prism, next, n, 0.0);
    }
    if ((points >> firstCenter & 1u) == 0u) return;
    const vec4 center = (edgePlace(prism, self, 0u) + edgePlace(prism, self, 1u) + edgePlace(prism, self, 2u)) / 3.0;
    [[dont_unroll]] for (uint n = 0u; n < 3u; ++n)
        write(skinCenter(self, n), vec4(center.xyz, hung[prism.vertices[n]].rest.w), prism, n, n, 0.0);
}
