#version 460
// The surface of a cut, fourth pass: the points that a slot owns, with what they hang on: a point on one side of a cut on that side's
// corners alone, one that holds both sides together on both.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "cut.glsl"
#include "link_masks.glsl"
#include "kuhn.glsl"
#include "cut_points.glsl"

layout(std430, binding = 0) readonly buffer Listed { uint listed[]; }; // how many, and then the slots
layout(std430, binding = 1) readonly buffer Owned { uvec4 owned[]; };
layout(std430, binding = 2) readonly buffer Partitions { uint partitions[]; };
layout(std430, binding = 3) readonly buffer Hits { LinkHits hits[]; };
layout(std430, binding = 4) readonly buffer Rest { vec4 rest[]; }; // where a blade has particles; w = index of the body's skin
layout(std430, binding = 5) writeonly buffer Vertices { CutVertex vertices[]; };

// Where a link was cut. One that died by rule K alone has no place: its middle.
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

// The low face of a tetrahedron that its cell may lack has the same corners.
void writeFace(uint i, uint q) {
    const Side side = firstSide(i, q);
    const uvec4 all = cornersOf(side.p);
    const uvec3 face = faceOf(side.m), corners = uvec3(all[face.x], all[face.y], all[face.z]);
    const vec3 place = (edgePlace(i, corners.x, corners.y) + edgePlace(i, corners.x, corners.z)
                        + edgePlace(i, corners.y, corners.z)) / 3.0;
    [[dont_unroll]] for (uint own = 0u; own < 3u; ++own) {
        if (!hasBit(owned[i], faceBit(q, own))) continue;
        uint slots[4] = uint[4](i, i, i, i), count = 0u;
        [[dont_unroll]] for (uint n = 0u; n < 3u; ++n)
            if (copyOf(owned[i], faceBit(q, n)) == faceBit(q, own)) slots[count++] = slotOf(i, corners[n]);
        const float share = 1.0 / float(count);
        write(i, faceBit(q, own), place, slots, vec4(share, count > 1u ? share : 0.0, count > 2u ? share : 0.0, 0.0));
    }
}

void writeMiddle(uint i, uint p) {
    const uvec4 corners = cornersOf(p), labels = labelsOf(partitionOf(partitions[i], p));
    if (!hasBit(owned[i], middleBit(p, 0u))) return;
    vec4 sum = vec4(0.0);
    [[dont_unroll]] for (uint a = 0u; a < 3u; ++a)
        [[dont_unroll]] for (uint b = a + 1u; b < 4u; ++b)
            if (labels[a] != labels[b]) sum += vec4(edgePlace(i, corners[a], corners[b]), 1.0);
    [[dont_unroll]] for (uint own = 0u; own < 4u; ++own) {
        if (labels[own] != own) continue;
        const vec4 isOf = vec4(equal(labels, uvec4(own)));
        const uint slots[4] = uint[4](slotOf(i, corners.x), slotOf(i, corners.y), slotOf(i, corners.z), slotOf(i, corners.w));
        write(i, middleBit(p, own), sum.xyz / sum.w, slots, isOf / dot(isOf, vec4(1.0)));
    }
}

void main() {
    const uint item = itemIndex(listed[0]);
    if (item >= listed[0]) return;
    const uint i = listed[1u + item];
    if (i - push.first >= push.count) return; // of another run
    [[dont_unroll]] for (uint d = 1u; d < 8u; ++d)
        if (hasBit(owned[i], edgeBit(d, 0u))) writeEdge(i, d);
    [[dont_unroll]] for (uint q = 0u; q < 12u; ++q)
        if (hasBit(owned[i], faceBit(q, 0u))) writeFace(i, q);
    [[dont_unroll]] for (uint p = 0u; p < tetrahedra; ++p) writeMiddle(i, p);
}
