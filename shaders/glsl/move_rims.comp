#version 460
// Vertices of a skin that a blade has left on the wrong side: it passed between them and the particle that they go with. They move to
// where it met an edge to a neighbour that goes with the same side, so that both rims of the cut are where the blade was; the skin beyond
// goes with the other side.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "cut.glsl"
#include "link_masks.glsl"
#include "kuhn.glsl"
#include "blade_hit.glsl"

layout(std430, binding = 0) readonly buffer PulledPlaces { vec4 pulledPlaces[]; };
layout(std430, binding = 1) readonly buffer PlacesBefore { vec4 before[]; };
layout(std430, binding = 2) readonly buffer Links { uint links[]; };
layout(std430, binding = 3) writeonly buffer Moved { vec4 moved[]; }; // of each vertex: where it is at rest; w = 0: where it was
layout(std430, binding = 4) readonly buffer Dirty { uint dirty[]; };
layout(std140, binding = 5) uniform Blade { BladeHead blade; };
layout(std430, binding = 6) readonly buffer Points { vec4 points[]; };
layout(std430, binding = 7) readonly buffer SavedLinks { uint savedLinks[]; };
layout(std430, binding = 8) readonly buffer Places { vec4 places[]; };
layout(std430, binding = 9) readonly buffer Rest { vec4 rest[]; };
layout(std430, binding = 10) readonly buffer Prisms { SkinPrism prisms[]; };
layout(std430, binding = 11) readonly buffer Hung { HungVertex hung[]; };
layout(std430, binding = 12) readonly buffer Rims { uint rims[]; };
layout(std430, binding = 13) readonly buffer Fans { uvec2 fans[]; };   // of each vertex: first, count of ...
layout(std430, binding = 14) readonly buffer Around { uint around[]; }; // 4 times a prism, and which of its corners the vertex is

#define PLACE(i) pulledPlaces[i].xyz
#include "blade_sweep.glsl"
#include "skin_prisms.glsl"
#define ALIVE(i) savedLinks[i]
#define AT(i) places[i].xyz
#define REST(i) rest[i].xyz
#define TURN(i) gradientAt(i)
#include "gradient.glsl"
#include "skin_place.glsl"

vec3 placeNow(HungVertex vertex) { return placeOf(vertex, heldWith(vertex.cell, vertex.corner)); }

// Whether the link below any edge from the vertex is dead.
bool isAtCut(uvec2 fan) {
    bool isCut = false;
    for (uint s = fan.x; s < fan.x + fan.y && !isCut; ++s) isCut = !isHeld(prisms[around[s] >> 2], around[s] & 3u);
    return isCut;
}

vec4 movedTo(HungVertex self, uvec2 fan) {
    const uint i = self.anchor;
    const vec3 x = placeNow(self);
    if (hitOf(i, i, x, PLACE(i)) > 1.0) return vec4(0.0);
    float least = 1e30;
    vec4 best = vec4(0.0);
    for (uint s = fan.x; s < fan.x + fan.y; ++s) {
        const SkinPrism prism = prisms[around[s] >> 2];
        const uint n = around[s] & 3u;
        if (!isHeld(prism, n)) continue;
        const HungVertex other = hung[prism.vertices[(n + 1u) % 3u]];
        const vec3 y = placeNow(other);
        const float t = hitOf(i, other.anchor, x, y), way = t * distance(x, y);
        if (t > 1.0 || way >= least) continue;
        least = way;
        best = vec4(mix(self.rest.xyz, other.rest.xyz, min(t, 0.95)), 1.0);
    }
    return best;
}

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint v = push.first + item;
    const HungVertex self = hung[v];
    if (dirty[self.anchor >> 5] == 0u || rims[v] != 0u) return; // beside a cut before, it stays
    moved[v] = isAtCut(fans[v]) ? movedTo(self, fans[v]) : vec4(0.0);
}
