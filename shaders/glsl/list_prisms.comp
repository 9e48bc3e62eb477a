#version 460
// Lists the prisms of a skin near the blade of a step, and those near the links that died, by the slots that they stand on. What is costly
// is done for these alone; the lists have no order, and need none.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

#include "blade_places.glsl"
#include "skin_slots.glsl"
#ifdef TEXELS
layout(binding = 5) uniform usamplerBuffer prisms; // SkinPrism
uvec3 anchorsOf(uint i) { return uvec3(texelFetch(prisms, int(3u * i)).w, texelFetch(prisms, int(3u * i + 1u)).xy); }
#else
layout(std430, binding = 5) readonly buffer Prisms { SkinPrism prisms[]; };
uvec3 anchorsOf(uint i) { return uvec3(prisms[i].anchors[0], prisms[i].anchors[1], prisms[i].anchors[2]); }
#endif
layout(std430, binding = 6) readonly buffer Status { StatusWords status; };
layout(std430, binding = 7) readonly buffer Dirty { uint dirty[]; };
layout(std430, binding = 8) buffer Counts { uint counts[]; };            // SKIN_LISTS of each body
layout(std430, binding = 9) writeonly buffer Nears { uint nears[]; };    // of a body from its first prism on
layout(std430, binding = 10) writeonly buffer Parted { uint parted[]; }; // likewise
layout(std430, binding = 11) buffer Flags { uint flags[]; };             // of slots
#ifdef TEXELS
layout(binding = 12) uniform samplerBuffer points;
#define POINT(n) texelFetch(points, int(n)).xyz
#else
layout(std430, binding = 12) readonly buffer Points { vec4 points[]; };
#endif
layout(push_constant) uniform Push { SkinSlotsPush push; };

#include "near_skin.glsl"
#include "dirty.glsl"

void listNear(uint i) {
    nears[push.prisms + atomicAdd(counts[SKIN_LISTS * push.run + SKIN_NEAR], 1u)] = i;
    const uvec3 anchors = anchorsOf(i);
    atomicOr(flags[anchors.x], SLOT_ASKED);
    if (anchors.y != anchors.x) atomicOr(flags[anchors.y], SLOT_ASKED);
    if (anchors.z != anchors.x && anchors.z != anchors.y) atomicOr(flags[anchors.z], SLOT_ASKED);
}

// A prism is listed once, by the first of its corners.
void listParted(uint i, uint corner) {
    const uvec3 anchors = anchorsOf(i);
    if (corner > 0u && isDirty(anchors.x) || corner > 1u && isDirty(anchors.y)) return;
    parted[push.prisms + atomicAdd(counts[SKIN_LISTS * push.run + SKIN_PARTED], 1u)] = i;
}

void main() {
    readBlade();
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const SkinSlot slot = slotAt(push.first + item);
    const bool isCutting = blade.quads > 0u && isFinished(status), isNear = isCutting && isNearBlade(slot.slot);
    const bool isNewStroke = isCutting && blade.isCarried == 0u;
    const bool wasMet = (atomicOr(flags[slot.slot], isNear ? SLOT_MET : 0u) & SLOT_MET) != 0u;
    if (isNewStroke && !isNear && wasMet) atomicAnd(flags[slot.slot], ~SLOT_MET);
    const bool isMet = isNear || isNewStroke && wasMet; // a new stroke forgets what older ones have met
    const bool isParted = isDirty(slot.slot);
    if (!isMet && !isParted) return;
    for (uint k = 0u; k < slot.corners; ++k) {
        const uint corner = HANGING(slot.first + k);
        if (isMet && (corner & 3u) == 0u) listNear(corner >> 2);
        if (isParted) listParted(corner >> 2, corner & 3u);
    }
}
