#version 460
// Ends a step for contact lists. The lists of an undone step may lack pairs: the positions for which they were made
// are set far away, and they are rebuilt at once. hasMemory: contact memory is saved, or restored if the step is
// undone.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Status { StatusWords status; };
layout(std430, binding = 1) buffer Detected { vec4 detected[]; }; // one per particle: position when lists were made
layout(std430, binding = 2) buffer Bounds { GridBounds bounds; };
layout(constant_id = 1) const bool hasMemory = false;
layout(std430, binding = 3) buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 4) buffer Lists { uvec2 lists[]; };
layout(std430, binding = 5) buffer Memory { vec4 memory[]; };
layout(std430, binding = 6) buffer Kept { vec4 kept[]; };
layout(std430, binding = 7) buffer KeptOthers { uint keptOthers[]; };
layout(std430, binding = 8) buffer KeptLists { uvec2 keptLists[]; };
#include "collision/keep_list.glsl"

void takeBack(uint i) {
    const uvec2 list = keptLists[i];
    lists[i] = list;
    for (uint element = list.x; element < list.x + list.y; ++element) {
        memory[element] = kept[element];
        contacts[element].other = keptOthers[element];
    }
}
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    const bool stays = isFinished(status);
    if (!stays && i < detected.length()) detected[i] = vec4(vec3(1e18), min(detected[i].w, 1e18)); // FRAME_NONE stays
    if (!stays && i == 0u) atomicMax(bounds.moved, floatBitsToUint(1e-30));
    if (i == 0u && status.candidates > 0u && bounds.lacksLists == 0u) bounds.lacking = status.candidates; // else less may be enough
    if (i == 0u) bounds.lacksLists = status.lacksLists;
    if (!hasMemory || i >= push.count) return;
    if (stays) keptLists[i] = keep(lists[i]);
    else takeBack(i);
}
