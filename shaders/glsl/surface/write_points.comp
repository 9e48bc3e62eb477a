#version 460
// The surface of a cut, fourth pass: the points that a slot owns, with the corners that each is bound to: a point on
// one side of a cut to the corners of that side alone, a point that joins both sides to both.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"
#include "lattice/kuhn.glsl"
#include "surface/cut_points.glsl"

layout(std430, binding = 0) readonly buffer Listed { uint listed[]; }; // the count, and then the slots
layout(std430, binding = 1) readonly buffer Owned { uvec4 owned[]; };
layout(std430, binding = 2) readonly buffer Partitions { uint partitions[]; };
layout(std430, binding = 3) readonly buffer Hits { LinkHits hits[]; };
layout(std430, binding = 4) readonly buffer Rest { vec4 rest[]; }; // particles as blades see them (move_places_below_skin); w = index of the body's skin
layout(std430, binding = 5) writeonly buffer Vertices { CutVertex vertices[]; };

// Position of the cut on a link; the midpoint for a link cut only by remove_loose_links, which stores no position.
float shareOf(uint slot, uint d) {
    const uint k = d - 1u, value = bitfieldExtract(k < 4u ? hits[slot].low : hits[slot].high, int(8u * (k & 3u)), 8);
    return value == 0u ? 0.5 : float(value) / 255.0;
}

vec3 edgePlace(uint cell, uint low, uint high) {
    const uint slot = slotOf(cell, low), d = low ^ high;
    return mix(rest[slot].xyz, rest[slotOf(cell, high)].xyz, shareOf(slot, d));
}

void write(uint i, uint bit, vec3 place, uint slots[4], vec4 shares) {
    const uint at = placeOf(owned[i], bit);
    vertices[at] = CutVertex(vec4(place, rest[i].w), shares, slots, int[3](0, 0, 0), at);
}

void writeEdge(uint i, uint d) {
    const uint far = slotOf(i, d);
    const vec3 place = edgePlace(i, 0u, d);
    const float share = shareOf(i, d);
    if (hasBit(owned[i], weldBit(d))) {
        write(i, edgeBit(d, 0u), place, uint[4](i, far, i, i), vec4(1.0 - share, share, 0.0, 0.0));
        return;
    }
    write(i, edgeBit(d, 0u), place, uint[4](i, i, i, i), vec4(1.0, 0.0, 0.0, 0.0));
    write(i, edgeBit(d, 1u), place, uint[4](far, far, far, far), vec4(1.0, 0.0, 0.0, 0.0));
}

#include "surface/center_points.glsl"

void main() {
    const uint item = itemIndex(listed[0]);
    if (item >= listed[0]) return;
    const uint i = listed[1u + item];
    if (i - push.first >= push.count) return; // belongs to another run
    [[dont_unroll]] for (uint d = 1u; d < 8u; ++d)
        if (hasBit(owned[i], edgeBit(d, 0u))) writeEdge(i, d);
    [[dont_unroll]] for (uint q = 0u; q < 12u; ++q)
        if (hasBit(owned[i], faceBit(q, 0u))) writeFace(i, q);
    [[dont_unroll]] for (uint p = 0u; p < tetrahedra; ++p) writeMiddle(i, p);
}
