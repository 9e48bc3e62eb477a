#version 460
// After lists of faces were made again: gives every pair what was remembered of it.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 1) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 2) writeonly buffer Memory { vec4 memory[]; }; // t [m], side
layout(std430, binding = 3) readonly buffer Kept { uvec4 kept[]; };     // bits of t; face, highest bit: side
layout(std430, binding = 4) readonly buffer KeptCounts { uint keptCounts[]; };
layout(push_constant) uniform Push { FacePush push; };

void main() {
    const uint i = itemIndex(push.count), n = counts[i], all = keptCounts[i];
    uint next = 0u; // both lists are sorted by face
    for (uint s = 0u; s < n; ++s) {
        const uint face = contacts[s * push.row + i].other;
        while (next < all && (kept[next * push.row + i].w & 0x7fffffffu) < face) ++next;
        vec4 found = vec4(0.0);
        if (next < all) {
            const uvec4 one = kept[next * push.row + i];
            if ((one.w & 0x7fffffffu) == face)
                found = vec4(uintBitsToFloat(one.xyz), (one.w & 0x80000000u) != 0u ? -1.0 : 1.0);
        }
        memory[s * push.row + i] = found;
    }
}
