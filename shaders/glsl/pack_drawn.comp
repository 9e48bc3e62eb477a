#version 460
// Mixed skins: copies the drawn triangles into a contiguous range of indices, so that a draw reads no others.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

#ifdef TEXELS
layout(binding = 0) uniform usamplerBuffer triangles;
layout(binding = 1) uniform usamplerBuffer drawn;
layout(binding = 2) uniform usamplerBuffer starts;
#define INDEX(n) texelFetch(triangles, int(n)).x
#define DRAWN(word) texelFetch(drawn, int(word)).x
#define START(word) texelFetch(starts, int(word)).x
#else
layout(std430, binding = 0) readonly buffer Triangles { uint triangles[]; };
layout(std430, binding = 1) readonly buffer Drawn { uint drawn[]; };
layout(std430, binding = 2) readonly buffer Starts { uint starts[]; };
#define INDEX(n) triangles[n]
#define DRAWN(word) drawn[word]
#define START(word) starts[word]
#endif
layout(std430, binding = 3) writeonly buffer Indices { uint indices[]; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const uint word = i / MIXED_WORD, bit = 1u << i % MIXED_WORD, bits = DRAWN(word);
    if ((bits & bit) == 0u) return;
    const uint to = START(word) + uint(bitCount(bits & bit - 1u));
    for (uint n = 0u; n < 3u; ++n) indices[3u * to + n] = INDEX(3u * i + n);
}
