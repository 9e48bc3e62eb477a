#version 460
// Lists the vertices of a skin for the passes near the blade: those of listed prisms, and those that may move, by
// their anchor slots.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

#include "common/blade_places.glsl"
#include "surface/skin_slots.glsl"
layout(std430, binding = 5) readonly buffer Status { StatusWords status; };
layout(std430, binding = 6) buffer Flags { uint flags[]; }; // one per slot
layout(std430, binding = 7) buffer Counts { uint counts[]; };
layout(std430, binding = 8) writeonly buffer Listed { uint listed[]; }; // each body begins at its first vertex
layout(std430, binding = 9) writeonly buffer Placed { PlacedVertex placed[]; };
#define POINTS_BINDING 10
#include "common/blade_points.glsl"
layout(std430, binding = 11) readonly buffer SavedLinks { uint savedLinks[]; };
layout(std430, binding = 12) readonly buffer Links { uint links[]; };
layout(push_constant) uniform Push { SkinSlotsPush push; };

#include "surface/near_skin.glsl"

void main() {
    readBlade();
    const uint item = itemIndex(push.count);
    if (item >= push.count || blade.quads == 0u || !isFinished(status)) return;
    const SkinSlot slot = slotAt(push.first + item);
    const uint word = flags[slot.slot];
    const bool isNear = (word & SLOT_ASKED) != 0u || isNearBlade(slot.slot), wasListed = (word & SLOT_LISTED) != 0u;
    const bool isOfStroke = isNear || blade.isCarried != 0u && (word & SLOT_OF_STROKE) != 0u;
    const bool isListed = isNear || !isOfStroke && (word & SLOT_OF_STROKE) != 0u; // a new stroke clears the state of earlier ones
    const bool hasLost = blade.isCarried != 0u && (word & (SLOT_LOSES | SLOT_LOST)) != 0u;
    const bool loses = links[slot.slot] != savedLinks[slot.slot];
    flags[slot.slot] = word & SLOT_MET | (isListed ? SLOT_LISTED : 0u) | (isOfStroke ? SLOT_OF_STROKE : 0u) |
                       (hasLost ? SLOT_LOST : 0u) | (loses ? SLOT_LOSES : 0u);
    if (!isListed && !wasListed) return;
    const uint first = slot.first + slot.corners;
    uint place = 0u;
    if (isListed) place = push.vertices + atomicAdd(counts[SKIN_LISTS * push.run + SKIN_VERTICES], slot.vertices);
    for (uint k = 0u; k < slot.vertices; ++k) {
        const uint v = HANGING(first + k);
        if (isListed) listed[place + k] = v;
        else placed[v].now = vec4(0.0);
    }
}
