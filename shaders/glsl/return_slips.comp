#version 460
// After lists were made again: gives every candidate what was remembered of it.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 1) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 2) writeonly buffer Slips { vec4 slips[]; };
layout(std430, binding = 3) readonly buffer Kept { uvec4 kept[]; }; // bits of t; the other particle
layout(std430, binding = 4) readonly buffer KeptCounts { uint keptCounts[]; };
#ifdef HAS_RECOVERY
layout(std430, binding = 5) readonly buffer KeptOffsets { float keptOffsets[]; }; // what is left of an overlap [m]
#define OFFSET(slot) keptOffsets[slot]
#else
#define OFFSET(slot) 0.0
#endif
layout(push_constant) uniform Push { FindPush push; };

void main() {
    const uint i = itemIndex(push.count), n = counts[i], all = keptCounts[i];
    uint next = 0u; // both lists are sorted by the other particle
    for (uint s = 0u; s < n; ++s) {
        const uint other = contacts[s * push.row + i].other;
        while (next < all && kept[next * push.row + i].w < other) ++next;
        const uint slot = next * push.row + i;
        const bool isKept = next < all && kept[slot].w == other;
        slips[s * push.row + i] = isKept ? vec4(uintBitsToFloat(kept[slot].xyz), OFFSET(slot)) : vec4(0.0);
    }
}
