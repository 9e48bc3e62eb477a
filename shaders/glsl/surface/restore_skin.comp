#version 460
// Makes the skins of bodies that came or went whole: where a blade met them, and where their vertices moved to.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Bodies { uint bodies[]; };   // by slot
layout(std430, binding = 1) readonly buffer Changes { uint changes[]; }; // by body: POOL_...
layout(std430, binding = 2) readonly buffer Status { StatusWords status; };
#include "surface/skin_slots.glsl"
layout(std430, binding = 5) writeonly buffer Flags { uint flags[]; }; // one per slot
layout(std430, binding = 6) writeonly buffer Hits { uint hits[]; };   // by prism
layout(std430, binding = 7) writeonly buffer Moved { vec4 moved[]; }; // one per bound vertex
layout(std430, binding = 8) writeonly buffer Rims { uint rims[]; };   // the same
layout(std430, binding = 9) writeonly buffer Placed { PlacedVertex placed[]; };
layout(push_constant) uniform Push { SkinSlotsPush push; };
#include "motions/changes.glsl"

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count || !isFinished(status)) return;
    const SkinSlot slot = slotAt(push.first + item);
    if (!comesOrGoes(bodies[slot.slot])) return;
    flags[slot.slot] = 0u;
    for (uint k = 0u; k < slot.corners; ++k) {
        const uint corner = HANGING(slot.first + k);
        if ((corner & 3u) == 0u) hits[corner >> 2] = 0u;
    }
    for (uint k = 0u; k < slot.vertices; ++k) {
        const uint v = HANGING(slot.first + slot.corners + k);
        moved[v] = vec4(0.0);
        rims[v] = 0u;
        placed[v] = PlacedVertex(vec4(0.0), vec4(0.0));
    }
}
