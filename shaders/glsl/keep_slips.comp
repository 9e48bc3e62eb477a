#version 460
// Before lists are made again: puts away what friction remembers of every candidate, with whom.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 1) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 2) readonly buffer Slips { vec4 slips[]; };
layout(std430, binding = 3) writeonly buffer Kept { uvec4 kept[]; }; // bits of t; the other particle
layout(std430, binding = 4) writeonly buffer KeptCounts { uint keptCounts[]; };
layout(push_constant) uniform Push { FindPush push; };

void main() {
    const uint i = itemIndex(push.count), n = counts[i];
    uint slipping = 0u; // what does not touch remembers nothing
    for (uint s = 0u; s < n; ++s) {
        const vec3 slip = slips[s * push.row + i].xyz;
        if (slip == vec3(0.0)) continue;
        kept[slipping * push.row + i] = uvec4(floatBitsToUint(slip), contacts[s * push.row + i].other);
        ++slipping;
    }
    keptCounts[i] = slipping;
}
