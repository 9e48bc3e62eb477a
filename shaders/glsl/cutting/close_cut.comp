#version 460
// Closes a step with a blade: counts the links that were cut, or restores them if the step is undone.
#extension GL_GOOGLE_include_directive : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"

#include "common/fetched.glsl"
FETCHED_UINT(0, SavedLinks, savedLinks)
FETCHED_VEC4(1, Places, placeAt)
#define SAVED(i) savedLinks(i)
#define PLACE(i) placeAt(i)
layout(std430, binding = 2) buffer Links { uint links[]; };
layout(std430, binding = 3) writeonly buffer PlacesBefore { vec4 before[]; };
layout(std430, binding = 4) readonly buffer Status { StatusWords status; };
layout(std430, binding = 5) buffer Work { CutWork work; };
layout(std430, binding = 6) readonly buffer Blade { BladeHead blade; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item;
    if (!isFinished(status)) {
        links[i] = SAVED(i);
        return;
    }
    if (blade.quads > 0u) before[i] = PLACE(i); // strokes continue over steps without a blade; a ray has no path
    const uint cut = SAVED(i) & ~links[i] & OWNED_MASK & push.stiffLinks;
    if (cut != 0u) atomicAdd(work.cut, uint(bitCount(cut)));
}
