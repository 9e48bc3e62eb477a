#version 460
// Where a blade has met the edges of a skin whose links it cut: in the state that the step begins with. Where
// it has not, it passed between an end of the edge and the particle that it goes with: then near that end.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "cut.glsl"
#include "link_masks.glsl"
#include "kuhn.glsl"
#include "blade_hit.glsl"

layout(std430, binding = 0) readonly buffer PulledPlaces { vec4 pulledPlaces[]; };
layout(std430, binding = 1) readonly buffer PlacesBefore { vec4 before[]; };
layout(std430, binding = 2) readonly buffer Links { uint links[]; };
layout(std430, binding = 3) buffer SkinHits { uint skinHits[]; }; // of each prism: byte n for its edge n, in 1/255; 0 = none
layout(std430, binding = 4) readonly buffer Dirty { uint dirty[]; };
layout(std140, binding = 5) uniform Blade { BladeHead blade; };
layout(std430, binding = 6) readonly buffer Points { vec4 points[]; };
layout(std430, binding = 7) readonly buffer SavedLinks { uint savedLinks[]; };
layout(std430, binding = 8) readonly buffer Places { vec4 places[]; };
layout(std430, binding = 9) readonly buffer Rest { vec4 rest[]; };
layout(std430, binding = 10) readonly buffer Prisms { SkinPrism prisms[]; };
layout(std430, binding = 11) readonly buffer Hung { HungVertex hung[]; };

#define PLACE(i) pulledPlaces[i].xyz
#include "blade_sweep.glsl"
#include "skin_prisms.glsl"
#define ALIVE(i) savedLinks[i]
#define AT(i) places[i].xyz
#define REST(i) rest[i].xyz
#define TURN(i) gradientAt(i)
#include "gradient.glsl"
#include "skin_place.glsl"

float hitOf(SkinPrism prism, uint n) {
    const HungVertex from = hung[prism.vertices[n]], to = hung[prism.vertices[(n + 1u) % 3u]];
    const vec3 a = placeOf(from, heldWith(from.cell, from.corner)), b = placeOf(to, heldWith(to.cell, to.corner));
    const uint i = from.anchor, j = to.anchor;
    const float t = hitOf(i, j, a, b);
    if (t <= 1.0) return t;
    const bool isBeforeA = hitOf(i, i, a, PLACE(i)) <= 1.0, isBeforeB = hitOf(j, j, b, PLACE(j)) <= 1.0;
    return isBeforeA == isBeforeB ? 0.5 : isBeforeA ? 0.0 : 1.0;
}

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item;
    const SkinPrism prism = prisms[i];
    if ((dirty[prism.anchors[0] >> 5] | dirty[prism.anchors[1] >> 5] | dirty[prism.anchors[2] >> 5]) == 0u) return;
    uint hits = skinHits[i];
    [[dont_unroll]] for (uint n = 0u; n < 3u; ++n) {
        if (isHeld(prism, n) || i > prism.beyond[n] >> 2 || !areLinked(savedLinks[lowEnd(prism, n)], linkOf(prism, n))) continue;
        hits = bitfieldInsert(hits, uint(round(255.0 * clamp(hitOf(prism, n), 0.02, 0.98))), int(8u * n), 8);
    }
    skinHits[i] = hits;
}
