#version 460
// Normals of split skins at vertices that only parts have; each lies in one whole triangle or on the edge of two. They are interpolated
// between the corners of one whole triangle, so that it looks as before the cut. The corners of a whole triangle beside a cut may be on
// the other side of it: there the rest normal, rotated with the material, is used instead.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Parts { PartVertex parts[]; };
#include "surface/skin_material.glsl"
#define HUNG_BINDING 7
#include "surface/hung_vertex.glsl"
layout(std430, binding = 8) readonly buffer Grids { SkinGrid grids[]; }; // by skin
layout(std430, binding = 9) buffer Vertices { SkinVertex vertices[]; };
layout(std430, binding = 10) readonly buffer Wholes { WholeTriangle wholes[]; };
layout(std430, binding = 11) readonly buffer States { uint states[]; };
layout(std430, binding = 12) readonly buffer Rims { uint rims[]; };
layout(push_constant) uniform Push { CountPush push; };

#include "surface/turned_normal.glsl"

vec3 normalOf(uint corner) { return vertices[hungAt(corner).vertex].normal.xyz; }

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const PartVertex part = parts[item];
    if (rims[part.vertex] != 0u) return; // rotate_rim_normals computes it
    const HungVertex vertex = hungAt(part.vertex);
    const WholeTriangle whole = wholes[part.whole];
    const float b = part.shares[0], c = part.shares[1];
    vec3 normal;
    if (states[part.whole] == WHOLE_PARTED) normal = turnedNormal(vertex);
    else normal = (1.0 - b - c) * normalOf(whole.vertices[0]) + b * normalOf(whole.vertices[1]) + c * normalOf(whole.vertices[2]);
    vertices[vertex.vertex].normal = unitNormal(normal);
}
