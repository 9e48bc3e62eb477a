#version 460
// Smooth vertex normals of the deformed skin: the normals of a vertex's triangles weighted by their angles there
// (Thuermer and Wuethrich 1998), so that splitting flat triangles changes nothing; gathered in fixed order.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_spirv_intrinsics : require
#define ALIASED spirv_decorate(20) // the buffer is bound twice, and written through one binding: Aliased
#include "common/kernel.glsl"

#ifdef TEXELS
ALIASED layout(std430, binding = 0) writeonly buffer Vertices { SkinVertex vertices[]; };
layout(binding = 1) uniform usamplerBuffer indices;
layout(binding = 2) uniform usamplerBuffer fans; // VertexTriangles
layout(binding = 3) uniform usamplerBuffer trianglesOfVertex;
ALIASED layout(binding = 4) uniform samplerBuffer places; // vertices, for reading
#define INDEX(t) texelFetch(indices, int(t)).x
#define FAN(i) texelFetch(fans, int(i)).xy
#define TRIANGLE(k) texelFetch(trianglesOfVertex, int(k)).x
#define VERTEX(i) texelFetch(places, int(2u * (i))).xyz
#define NEXT 5
#else
layout(std430, binding = 0) buffer Vertices { SkinVertex vertices[]; };
layout(std430, binding = 1) readonly buffer Indices { uint indices[]; };
layout(std430, binding = 2) readonly buffer Fans { VertexTriangles fans[]; };
layout(std430, binding = 3) readonly buffer TrianglesOfVertex { uint trianglesOfVertex[]; };
#define INDEX(t) indices[t]
#define FAN(i) uvec2(fans[i].first, fans[i].count)
#define TRIANGLE(k) trianglesOfVertex[k]
#define VERTEX(i) vertices[i].position.xyz
#define NEXT 4
#endif
#ifdef WHOLE // corners of whole triangles around which none is beside a cut
layout(std430, binding = NEXT) readonly buffer Hung { HungVertex hung[]; };
layout(std430, binding = NEXT + 1) readonly buffer Marks { uint marks[]; }; // one per bound vertex
layout(push_constant) uniform Push { WholePush push; };
#else
layout(push_constant) uniform Push { CountPush push; };
#endif

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
#ifdef WHOLE
    const uint i = hung[item].vertex;
    if (i >= push.vertices || marks[item] != 0u) return;
#else
    const uint i = item;
#endif
    const uvec2 fan = FAN(i);
#ifdef WHOLE
    if (fan.y == 0u) return;
#endif
    const vec3 here = VERTEX(i);
    const float blur = NORMAL_BLUR * dot(here, here) + 1e-37; // [m^2]
    vec3 sum = vec3(0.0);
    for (uint s = 0u; s < fan.y; ++s) {
        const uint t = 3u * TRIANGLE(fan.x + s);
        const uint a = INDEX(t), b = INDEX(t + 1u), c = INDEX(t + 2u);
        const uint next = a == i ? b : b == i ? c : a, last = a == i ? c : b == i ? a : b;
        const vec3 u = VERTEX(next) - here, v = VERTEX(last) - here;
        const vec3 across = cross(u, v);
        const float twice = length(across); // twice the area
        const float longest = max(max(dot(u, u), dot(v, v)), dot(v - u, v - u)), height = twice * twice / max(longest, 1e-37); // squared
        const float weight = atan(twice, dot(u, v)) * height / (height + blur);
        sum += twice > 0.0 ? weight / twice * across : vec3(0.0);
    }
    const float size = length(sum);
    vertices[i].normal = vec4(size > 0.0 ? sum / size : vec3(0.0, 1.0, 0.0), 0.0);
}
