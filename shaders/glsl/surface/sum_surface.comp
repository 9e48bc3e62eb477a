#version 460
// Sums the counts of a cut surface over a chunk of slots.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Counts { SurfaceCounts counts[]; };
layout(std430, binding = 1) writeonly buffer Sums { uvec4 sums[]; }; // points, inner triangles, outer triangles, slots with any part
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint chunk = itemIndex(push.count);
    if (chunk >= push.count) return;
    uvec4 sum = uvec4(0u);
    for (uint i = chunk * SURFACE_CHUNK; i < (chunk + 1u) * SURFACE_CHUNK; ++i) {
        const uint sizes = counts[i].sizes;
        sum += uvec4(sizes & 255u, sizes >> 8 & 255u, sizes >> 16, min(sizes, 1u));
    }
    sums[chunk] = sum;
}
