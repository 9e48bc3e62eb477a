#version 460
// Smooth vertex normals of the deformed skin: the normals of a vertex's triangles weighted by their angles there
// (Thuermer and Wuethrich 1998), so that splitting flat triangles changes nothing; gathered in fixed order.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_spirv_intrinsics : require
#define ALIASED spirv_decorate(20) // the buffer is bound twice, and written through one binding: Aliased
#include "common/kernel.glsl"

#include "common/fetched.glsl"
ALIASED layout(std430, binding = 0) buffer Vertices { SkinVertex vertices[]; };
ALIASED TEXEL_TWIN(0, samplerBuffer, vertexTexels);
FETCHED_UINT(1, Indices, indexAt)
FETCHED_UVEC2(2, Fans, fanAt) // VertexTriangles
FETCHED_UINT(3, TrianglesOfVertex, triangleAt)
vec3 placeAt(uint i) {
    if (usesTexels) return texelFetch(vertexTexels, int(2u * i)).xyz;
    return vertices[i].position.xyz;
}
#define INDEX(t) indexAt(t)
#define FAN(i) fanAt(i)
#define TRIANGLE(k) triangleAt(k)
#define VERTEX(i) placeAt(i)
// Computes all vertices, or only corners of whole triangles around which none is beside a cut.
layout(constant_id = 1) const bool isOfWholes = false;
layout(std430, binding = 4) readonly buffer Hung { HungVertex hung[]; };
layout(std430, binding = 5) readonly buffer Marks { uint marks[]; }; // one per bound vertex
layout(push_constant) uniform Push { WholePush push; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    uint i = item;
    if (isOfWholes) {
        i = hung[item].vertex;
        if (i >= push.vertices || marks[item] != 0u) return;
    }
    const uvec2 fan = FAN(i);
    if (isOfWholes && fan.y == 0u) return;
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
