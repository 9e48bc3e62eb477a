#version 460
// After lists of faces or edges were made again: gives every pair what was remembered of it.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 1) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 2) writeonly buffer Memory { vec4 memory[]; }; // t [m]; side and overlap
layout(std430, binding = 3) readonly buffer Kept { vec4 kept[]; };
layout(std430, binding = 4) readonly buffer KeptOthers { uint keptOthers[]; }; // the face or edge
layout(std430, binding = 5) readonly buffer KeptCounts { uint keptCounts[]; };
layout(push_constant) uniform Push { FacePush push; };

void main() {
    const uint i = itemIndex(push.count), n = counts[i], all = keptCounts[i];
    uint next = 0u; // both lists are sorted
    for (uint s = 0u; s < n; ++s) {
        const uint other = contacts[s * push.row + i].other;
        while (next < all && keptOthers[next * push.row + i] < other) ++next;
        const bool isKept = next < all && keptOthers[next * push.row + i] == other;
        memory[s * push.row + i] = isKept ? kept[next * push.row + i] : vec4(0.0);
    }
}
