#version 460
// Lists the prisms of a skin near the blade of a step, whose vertices are marked, and those near the links that died. What is costly is
// done for these alone; the lists have no order, and need none.
#extension GL_GOOGLE_include_directive : require
#include "cut.glsl"

layout(std430, binding = 0) readonly buffer PulledPlaces { vec4 pulledPlaces[]; };
layout(std430, binding = 1) readonly buffer PlacesBefore { vec4 before[]; };
layout(std430, binding = 2) readonly buffer Blade { BladeHead blade; };
layout(std430, binding = 3) readonly buffer Status { StatusWords status; };
layout(std430, binding = 4) readonly buffer Prisms { SkinPrism prisms[]; };
layout(std430, binding = 5) readonly buffer SkinHits { uint skinHits[]; };
layout(std430, binding = 6) readonly buffer Dirty { uint dirty[]; };
layout(std430, binding = 7) buffer Counts { uint counts[]; }; // SKIN_LISTS of each body
layout(std430, binding = 8) writeonly buffer Nears { uint nears[]; };    // of a body from its first prism on
layout(std430, binding = 9) writeonly buffer Parted { uint parted[]; };  // likewise
layout(std430, binding = 10) writeonly buffer Marks { uint marks[]; };   // of vertices: 1 = of a prism near the blade

#define PLACE(i) pulledPlaces[i].xyz
#include "near_blade.glsl"
#include "dirty.glsl"

// A new stroke forgets what older ones have met.
bool isMet(uint i, uint anchor) {
    return blade.quads > 0u && isFinished(status) && (isNearBlade(anchor) || skinHits[i] != 0u && blade.isCarried == 0u);
}

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item;
    const SkinPrism prism = prisms[i];
    if (isMet(i, prism.anchors[0])) {
        nears[push.first + atomicAdd(counts[SKIN_LISTS * push.run + SKIN_NEAR], 1u)] = i;
        marks[prism.vertices[0]] = marks[prism.vertices[1]] = marks[prism.vertices[2]] = 1u;
    }
    if (isDirty(prism.anchors[0]) || isDirty(prism.anchors[1]) || isDirty(prism.anchors[2]))
        parted[push.first + atomicAdd(counts[SKIN_LISTS * push.run + SKIN_PARTED], 1u)] = i;
}
