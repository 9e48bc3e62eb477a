#version 460
// Computes the start of every slot's part of a cut surface, and lists the slots that have any: the passes that write
// run over that list, so that all lanes have work.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Counts { SurfaceCounts counts[]; };
layout(std430, binding = 1) readonly buffer Sums { uvec4 sums[]; }; // points, inner triangles, outer triangles, slots before the chunk
layout(std430, binding = 2) buffer Owned { uvec4 owned[]; };        // w: the first point
layout(std430, binding = 3) writeonly buffer Starts { uvec2 starts[]; }; // first inner and first outer triangle
layout(std430, binding = 4) writeonly buffer Listed { uint listed[]; };  // the count, and then the slots
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint chunk = itemIndex(push.count);
    if (chunk >= push.count) return;
    uvec4 next = sums[chunk];
    for (uint i = chunk * SURFACE_CHUNK; i < (chunk + 1u) * SURFACE_CHUNK; ++i) {
        const uint sizes = counts[i].sizes;
        if (sizes == 0u) continue;
        owned[i].w = next.x;
        starts[i] = next.yz;
        listed[1u + next.w] = i;
        next += uvec4(sizes & 255u, sizes >> 8 & 255u, sizes >> 16, 1u);
    }
}
