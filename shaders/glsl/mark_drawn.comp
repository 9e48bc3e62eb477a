#version 460
// Marks the drawn triangles of mixed skins, a bit for each of the MIXED_WORD triangles of an item. Few are drawn; the
// others are collapsed to points.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

#ifdef TEXELS
layout(binding = 0) uniform usamplerBuffer triangles;
#define INDEX(n) texelFetch(triangles, int(n)).x
#else
layout(std430, binding = 0) readonly buffer Triangles { uint triangles[]; };
#define INDEX(n) triangles[n]
#endif
layout(std430, binding = 1) writeonly buffer Drawn { uint drawn[]; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint word = itemIndex(push.count);
    if (word >= push.count) return;
    uint bits = 0u;
    for (uint t = 0u; t < MIXED_WORD; ++t) {
        const uint first = 3u * (MIXED_WORD * word + t);
        bits |= uint(INDEX(first) != INDEX(first + 1u)) << t;
    }
    drawn[word] = bits;
}
