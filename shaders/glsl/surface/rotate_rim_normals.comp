#version 460
// Normals of skins beside a cut: rest normals, rotated with the material. In split skins also those at corners of whole triangles beside
// a cut, where the gradient of the material is known: corners farther away have the normal of their triangles, none of which is
// distorted by a rim.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Rims { uint rims[]; };
#include "surface/skin_material.glsl"
#define HUNG_BINDING 7
#include "surface/hung_vertex.glsl"
layout(std430, binding = 8) readonly buffer Grids { SkinGrid grids[]; }; // by skin
layout(std430, binding = 9) writeonly buffer Vertices { SkinVertex vertices[]; };
layout(std430, binding = 10) readonly buffer Marks { uint marks[]; };
layout(constant_id = 1) const bool isSplit = false; // the skin is
layout(push_constant) uniform Push { PrismPush push; };

#include "surface/turned_normal.glsl"

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    bool isTurned = rims[i] != 0u;
    if (isSplit) isTurned = isTurned || (marks[i] != 0u && NEAR(hungAt(i).anchor) != 0u);
    if (!isTurned) return;
    const HungVertex vertex = hungAt(i);
    vertices[vertex.vertex].normal = unitNormal(turnedNormal(vertex));
}
