#version 460
// Lists the prisms of a skin near the blade of a step, and those near dead links, by their anchor slots. Costly
// passes run for these alone; the order of the lists does not matter.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/kernel.glsl"

#include "common/blade_places.glsl"
#include "surface/skin_slots.glsl"
#define PRISM_BINDING 5
#include "surface/skin_prism.glsl"
layout(std430, binding = 6) readonly buffer Status { StatusWords status; };
layout(std430, binding = 7) readonly buffer Dirty { uint dirty[]; };
layout(std430, binding = 8) buffer Counts { uint counts[]; };            // SKIN_LISTS of each body
layout(std430, binding = 9) writeonly buffer Nears { uint nears[]; };    // each body begins at its first prism
layout(std430, binding = 10) writeonly buffer Parted { uint parted[]; }; // the same
layout(std430, binding = 11) buffer Flags { uint flags[]; };             // one per slot
#define POINTS_BINDING 12
#include "common/blade_points.glsl"
layout(push_constant) uniform Push { SkinSlotsPush push; };

#include "surface/near_skin.glsl"
#include "lattice/dirty.glsl"

void listNear(uint i) {
    nears[push.prisms + atomicAdd(counts[SKIN_LISTS * push.run + SKIN_NEAR], 1u)] = i;
    const uint anchors[3] = prismAt(i).anchors;
    [[unroll]] for (uint n = 0u; n < 3u; ++n) atomicOr(flags[anchors[n]], SLOT_ASKED);
}

// Lists a prism once, at the first of its corners near a dead link.
void listParted(uint i, uint corner) {
    const uint anchors[3] = prismAt(i).anchors;
    if (corner > 0u && isDirty(anchors[0]) || corner > 1u && isDirty(anchors[1])) return;
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
    const bool isMet = isNear || isNewStroke && wasMet; // a new stroke clears the hits of earlier ones
    const bool isParted = isDirty(slot.slot);
    if (!isMet && !isParted) return;
    for (uint k = 0u; k < slot.corners; ++k) {
        const uint corner = HANGING(slot.first + k);
        if (isMet && (corner & 3u) == 0u) listNear(corner >> 2);
        if (isParted) listParted(corner >> 2, corner & 3u);
    }
}
