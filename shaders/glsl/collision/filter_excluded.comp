#version 460
// Excluded pairs after a cut. Linked particles never touch each other, particles on both sides of a cut do: of
// each particle's excluded partners in later slots, those still linked with it are kept. Rows stay sorted and as long as
// before: the last entry is repeated. If links were cut or restored, all contact lists are rebuilt.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"
#include "lattice/link_ways.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer SavedLinks { uint savedLinks[]; };
layout(std430, binding = 2) readonly buffer Counts { uint listedCounts[]; };
layout(std430, binding = 3) readonly buffer AllExcluded { uint allExcluded[]; }; // exclusions of the uncut body
layout(std430, binding = 4) buffer Excluded { uint excluded[]; };
layout(std430, binding = 5) buffer Bounds { GridBounds bounds; };
layout(std430, binding = 6) readonly buffer Listed { uint listed[]; };
#include "common/listed_slot.glsl"

bool staysExcluded(uint i, uint partner) {
    const uint ways = linksTo(int(partner) - int(i), push.rowStride, push.sliceStride);
    return ways == 0u || (links[i] & ways) != 0u;
}

void main() {
    const uint i = listedSlot();
    if (i == NO_SLOT) return;
    if (links[i] != savedLinks[i] && bounds.moved == 0u) atomicMax(bounds.moved, 1u);
    const uint end = allExcluded[i + 1u];
    uint next = allExcluded[i], last = i; // no particle is listed with itself
    for (uint e = allExcluded[i]; e < end; ++e) {
        if (!staysExcluded(i, allExcluded[e])) continue;
        last = allExcluded[e];
        excluded[next++] = last;
    }
    for (; next < end; ++next) excluded[next] = last;
}
