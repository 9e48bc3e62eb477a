#version 460
// Normals of mixed skins at vertices of parts alone, which lie in one triangle of the mesh or on the edge of two:
// interpolated between the normals of the triangle's corners, as when it is drawn whole, so that the two look alike.
// Beside a cut the corners may be on its other side, and the gradient of the material is used instead.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Parts { PartVertex parts[]; };
#include "skin_material.glsl"
#define HUNG_BINDING 7
#include "hung_vertex.glsl"
layout(std430, binding = 8) readonly buffer Grids { SkinGrid grids[]; }; // by skin
layout(std430, binding = 9) buffer Vertices { SkinVertex vertices[]; };
layout(std430, binding = 10) readonly buffer Wholes { WholeTriangle wholes[]; };
layout(std430, binding = 11) readonly buffer States { uint states[]; };
layout(std430, binding = 12) readonly buffer Rims { uint rims[]; };
#ifdef SHOWN
layout(std430, binding = 13) readonly buffer Shown { uint shown[]; };
#endif
layout(push_constant) uniform Push { CountPush push; };

#include "turned_normal.glsl"

vec3 normalOf(uint corner) { return vertices[hungAt(corner).vertex].normal.xyz; }

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const PartVertex part = parts[item];
    if (rims[part.vertex] != 0u) return; // turn_rims computes it
    const HungVertex vertex = hungAt(part.vertex);
#ifdef SHOWN
    if ((shown[vertex.vertex] & VERTEX_SHOWN) == 0u) return;
#endif
    const WholeTriangle whole = wholes[part.whole];
    const float b = part.shares[0], c = part.shares[1];
    vec3 normal;
    if (states[part.whole] == WHOLE_PARTED) normal = turnedNormal(vertex);
    else normal = (1.0 - b - c) * normalOf(whole.vertices[0]) + b * normalOf(whole.vertices[1]) + c * normalOf(whole.vertices[2]);
    vertices[vertex.vertex].normal = unitNormal(normal);
}
