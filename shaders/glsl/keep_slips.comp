#version 460
// Before lists are made again: puts away what is remembered of every candidate, with whom.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 1) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 2) readonly buffer Slips { vec4 slips[]; };
layout(std430, binding = 3) writeonly buffer Kept { uvec4 kept[]; }; // bits of t; the other particle
layout(std430, binding = 4) writeonly buffer KeptCounts { uint keptCounts[]; };
#ifdef HAS_RECOVERY
layout(std430, binding = 5) writeonly buffer KeptOffsets { float keptOffsets[]; }; // what is left of an overlap [m]
#endif
layout(push_constant) uniform Push { FindPush push; };

void main() {
    const uint i = itemIndex(push.count), n = counts[i];
    uint slipping = 0u; // what does not touch remembers nothing
    for (uint s = 0u; s < n; ++s) {
        const vec4 slip = slips[s * push.row + i];
        if (slip == vec4(0.0)) continue;
        const uint slot = slipping * push.row + i;
        kept[slot] = uvec4(floatBitsToUint(slip.xyz), contacts[s * push.row + i].other);
#ifdef HAS_RECOVERY
        keptOffsets[slot] = slip.w;
#endif
        ++slipping;
    }
    keptCounts[i] = slipping;
}
