#version 460
// The surface of a cut, second pass for skins of meshes: finds the connectivity of the corners of every prism near
// the last blade, the points that exist (as mark_points does for tetrahedra), and the number of triangles.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/kernel.glsl"
#include "lattice/link_masks.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer ListCounts { uint listCounts[]; };
layout(std430, binding = 2) readonly buffer Prisms { SkinPrism prisms[]; };
layout(std430, binding = 3) writeonly buffer Near { uint near[]; };    // 1 = a point may be bound to the particle
layout(std430, binding = 4) writeonly buffer Owned { uvec4 owned[]; };
layout(std430, binding = 5) writeonly buffer Counts { SurfaceCounts counts[]; };
layout(std430, binding = 6) writeonly buffer Rims { uint rims[]; };    // one per bound vertex: 1 = a triangle around it is drawn in pieces
layout(std430, binding = 7) readonly buffer Parted { uint parted[]; };  // prisms near dead links (list_prisms)
layout(push_constant) uniform Push { PrismPush push; };

#include "surface/skin_prisms.glsl"

void main() {
    const uint count = listCounts[SKIN_LISTS * push.run + SKIN_PARTED], item = itemIndex(count);
    if (item >= count) return;
    const uint i = parted[push.prisms + item];
    const SkinPrism prism = prisms[i];
    const uvec3 pattern = patternOf(prism);
    const uint ways = 1u + (pattern.y == 1u ? 1u : 0u) + (pattern.z == 2u ? 1u : 0u);
    uint points = 0u, used = 0u;
    [[dont_unroll]] for (uint n = 0u; n < 3u; ++n) {
        if (isHeld(prism, n)) continue;
        const bool isApart = areApart(pattern, n), isApartBeyond = areApart(patternOf(prisms[prism.beyond[n] >> 2]), prism.beyond[n] & 3u);
        if (!isApart && !isApartBeyond) continue;
        used |= 1u << n;
        if (i < prism.beyond[n] >> 2) points |= 1u << 2u * n | (isApart && isApartBeyond ? 2u << 2u * n : 1u << 6u + n);
    }
    if (ways == 3u) points |= 7u << firstCenter;
    const bool isThin = linkOf(prism, 0u) == 0u || linkOf(prism, 1u) == 0u || linkOf(prism, 2u) == 0u;
    const uint inside = ways == 1u ? 0u : ways == 3u ? 12u : isThin ? 2u : 4u;
    const uint outside = ways == 1u ? (used == 0u ? 0u : 2u) : ways == 2u ? 3u : 6u;
    owned[push.first + i] = uvec4(points, 0u, 0u, 0u);
    counts[push.first + i] = SurfaceCounts(bitCount(points & skinPoints) | inside << 8 | outside << 16, outside == 0u ? 0u : 1u);
    [[dont_unroll]] for (uint n = 0u; n < 3u && outside > 0u; ++n) {
        near[prism.anchors[n]] = 1u;
        rims[prism.vertices[n]] = 1u;
    }
}
