#version 460
// Intersects the blade with the edges of a skin that it may cut, in the state at the start of the step. A slow blade
// meets an edge in one step and cuts the link below it in another, so hits are kept; a new stroke clears the hits of
// edges whose links are alive. Edges that were parted before are gaps and meet no later stroke.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"
#include "lattice/kuhn.glsl"
#include "common/blade_hit.glsl"

#include "common/blade_places.glsl"
#include "lattice/saved_links.glsl"
#define POINTS_BINDING 4
#include "common/blade_points.glsl"
#define PRISM_BINDING 5
#include "surface/skin_prism.glsl"
layout(std430, binding = 6) readonly buffer Placed { PlacedVertex placed[]; }; // (place_vertices)
TEXEL_TWIN(6, samplerBuffer, placedTexels);
PlacedVertex placedAt(uint v) {
    if (usesTexels) return PlacedVertex(texelFetch(placedTexels, int(2u * v)), texelFetch(placedTexels, int(2u * v + 1u)));
    return placed[v];
}
layout(std430, binding = 7) buffer SkinHits { uint skinHits[]; }; // one per prism: byte n = hit on its edge n, in 1/255; 0 = none; then a bit for each (partedBit)
layout(std430, binding = 8) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 9) readonly buffer Nears { uint nears[]; }; // prisms (list_prisms)
#define MOVED_BINDING 10
#include "surface/moved_vertex.glsl"

#include "surface/near_skin.glsl"
#include "common/blade_sweep.glsl"
#include "surface/prism_links.glsl"
#include "surface/rim_share.glsl"

void main() {
    readBlade();
    const uint count = counts[SKIN_LISTS * push.run + SKIN_NEAR], item = itemIndex(count);
    if (item >= count) return;
    const uint i = nears[push.first + item];
    const SkinPrism prism = prismAt(i);
    const bool isNear = isNearBlade(prism.anchors[0]);
    uint hits = skinHits[i];
    [[dont_unroll]] for (uint n = 0u; n < 3u; ++n) {
        if (linkOf(prism, n) == 0u || i > prism.beyond[n] >> 2) continue;
        const bool isWhole = areLinked(SAVED(lowEnd(prism, n)), linkOf(prism, n));
        const uint next = (n + 1u) % 3u;
        const uint start = prism.vertices[n], end = prism.vertices[next];
        uint hit = bitfieldExtract(hits, int(8u * n), 8);
        if (isWhole && blade.isCarried == 0u) hit = 0u;
        if (isWhole) hits &= ~partedBit(n);
        bool isGap = !isWhole && blade.isCarried == 0u;
        if (isNear && !isGap && (hits & partedBit(n)) == 0u && (isWhole || hit == 0u)) {
            const PlacedVertex a = placedAt(start), b = placedAt(end);
            isGap = !isWhole && a.before.w + b.before.w == 0.0; // something else has torn it
            const float at = isGap ? never : hitOf(Ends(a.before.xyz, b.before.xyz, a.now.xyz, b.now.xyz));
            if (at <= 1.0) hit = uint(roundEven(255.0 * clamp(at, 0.02, 0.98)));
        }
        if (isGap && (hits & partedBit(n)) == 0u) {
            hit = rimShare(MOVED(start).w, MOVED(end).w, hit);
            hits |= partedBit(n);
        }
        hits = bitfieldInsert(hits, hit, int(8u * n), 8);
    }
    skinHits[i] = hits;
}
