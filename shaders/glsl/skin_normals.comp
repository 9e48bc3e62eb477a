#version 460
// Smooth vertex normals of the deformed skin: those of a vertex's triangles by their angles there (Thuermer and Wuethrich 1998),
// so that they stay as they are where flat ones are split, gathered in fixed order. Triangles of which one side is much shorter
// than the other count less: slivers of a split skin say little of where it faces.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) buffer Vertices { SkinVertex vertices[]; };
layout(std430, binding = 1) readonly buffer Indices { uint indices[]; };
layout(std430, binding = 2) readonly buffer Fans { VertexTriangles fans[]; };
layout(std430, binding = 3) readonly buffer TrianglesOfVertex { uint trianglesOfVertex[]; };
#ifdef WHOLE // of mixed skins: where all triangles around a vertex are whole
layout(std430, binding = 4) readonly buffer Hung { HungVertex hung[]; };
layout(std430, binding = 5) readonly buffer Marks { uint marks[]; }; // of vertices that hang
layout(push_constant) uniform Push { WholePush push; };
#else
#ifdef SHOWN // what drawing a mixed skin takes
layout(std430, binding = 4) readonly buffer Shown { uint shown[]; };
#endif
layout(push_constant) uniform Push { CountPush push; };
#endif

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
#ifdef WHOLE
    const uint i = hung[item].vertex;
    if (i >= push.vertices || marks[item] != 0u || fans[i].count == 0u) return;
#else
    const uint i = item;
#endif
#ifdef SHOWN
    if (shown[i] != VERTEX_SHOWN) return;
#endif
    const vec3 here = vertices[i].position.xyz;
    vec3 sum = vec3(0.0);
    for (uint s = 0u; s < fans[i].count; ++s) {
        const uint t = 3u * trianglesOfVertex[fans[i].first + s];
        const uint a = indices[t], b = indices[t + 1u], c = indices[t + 2u];
        const uint next = a == i ? b : b == i ? c : a, last = a == i ? c : b == i ? a : b;
        const vec3 u = vertices[next].position.xyz - here, v = vertices[last].position.xyz - here;
        const vec3 across = cross(u, v);
        const float twice = length(across); // the area
        const float evenness = min(dot(u, u), dot(v, v)) / max(dot(u, u), dot(v, v));
        const float weight = atan(twice, dot(u, v)) * evenness / (evenness + 0.01);
        sum += twice > 0.0 ? weight / twice * across : vec3(0.0);
    }
    const float size = length(sum);
    vertices[i].normal = vec4(size > 0.0 ? sum / size : vec3(0.0, 1.0, 0.0), 0.0);
}
