#version 460
// Normals of skins beside a cut: triangles around such a vertex are in pieces, so it has that at rest, turned with the material.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Rims { uint rims[]; };
layout(std430, binding = 1) readonly buffer Hung { HungVertex hung[]; };
layout(std430, binding = 2) readonly buffer Gradients { Gradient gradients[]; };
layout(std430, binding = 3) writeonly buffer Vertices { SkinVertex vertices[]; };
layout(push_constant) uniform Push { PrismPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count || rims[i] == 0u) return;
    const Gradient g = gradients[hung[i].anchor];
    const mat3 cofactor = mat3(cross(g.y.xyz, g.z.xyz), cross(g.z.xyz, g.x.xyz), cross(g.x.xyz, g.y.xyz));
    const vec3 normal = cofactor * hung[i].normal.xyz;
    const float size = length(normal);
    vertices[hung[i].vertex].normal = vec4(size > 0.0 ? normal / size : vec3(0.0, 1.0, 0.0), 0.0);
}
