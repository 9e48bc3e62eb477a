#version 460
// Counts the links of each body that a blade has cut in a step, and those that have torn after it.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "events/events.h"
#include "lattice/link_masks.glsl"

layout(std430, binding = 0) readonly buffer Bodies { uint bodies[]; };         // by slot
layout(std430, binding = 1) readonly buffer SavedLinks { uint savedLinks[]; }; // before the step
layout(std430, binding = 2) readonly buffer CutLinks { uint cutLinks[]; };     // after the blade
layout(std430, binding = 3) readonly buffer Links { uint links[]; };
layout(std430, binding = 4) readonly buffer Counts { uint listedCounts[]; };
layout(std430, binding = 5) readonly buffer Listed { uint listed[]; };
layout(std430, binding = 6) buffer Noted { BodyEvents noted[]; };
layout(constant_id = 1) const bool tears = false;
layout(push_constant) uniform Push { EventCutPush push; };
#include "common/listed_slot.glsl"

void main() {
    const uint i = listedSlot();
    if (i == NO_SLOT || bodies[i] == NO_BODY) return;
    const uint counted = savedLinks[i] & OWNED_MASK & push.stiffLinks;
    const uint dead = counted & ~links[i], torn = tears ? dead & cutLinks[i] : 0u;
    if (dead != torn) atomicAdd(noted[bodies[i]].cut, uint(bitCount(dead & ~torn)));
    if (torn != 0u) atomicAdd(noted[bodies[i]].torn, uint(bitCount(torn)));
}
