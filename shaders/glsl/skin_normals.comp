#version 460
// Smooth vertex normals of the deformed skin: the area-weighted sum over a vertex's triangles, gathered in fixed order.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) buffer Vertices { SkinVertex vertices[]; };
layout(std430, binding = 1) readonly buffer Indices { uint indices[]; };
layout(std430, binding = 2) readonly buffer Fans { VertexTriangles fans[]; };
layout(std430, binding = 3) readonly buffer TrianglesOfVertex { uint trianglesOfVertex[]; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    vec3 sum = vec3(0.0);
    for (uint s = 0u; s < fans[i].count; ++s) {
        const uint t = 3u * trianglesOfVertex[fans[i].first + s];
        const vec3 a = vertices[indices[t]].position.xyz;
        sum += cross(vertices[indices[t + 1u]].position.xyz - a, vertices[indices[t + 2u]].position.xyz - a);
    }
    const float size = length(sum);
    vertices[i].normal = vec4(size > 0.0 ? sum / size : vec3(0.0, 1.0, 0.0), 0.0);
}
