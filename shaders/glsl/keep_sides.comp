#version 460
// What contacts with faces remember, put away with which face it was: before lists are made again, and, PUBLISH, when a
// step ends. A step that is undone takes it back; its lists may lack pairs, so nobody is where they were made any more.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 1) buffer Counts { uint counts[]; };
layout(std430, binding = 2) buffer Memory { vec4 memory[]; }; // t [m], side
layout(std430, binding = 3) buffer Kept { uvec4 kept[]; };    // bits of t; face, highest bit: side
layout(std430, binding = 4) buffer KeptCounts { uint keptCounts[]; };
#ifdef PUBLISH
layout(std430, binding = 5) readonly buffer Status { StatusWords status; };
layout(std430, binding = 6) writeonly buffer Detected { vec4 detected[]; };
#endif
layout(push_constant) uniform Push { FacePush push; };

void keep(uint i) {
    uint touching = 0u; // what does not touch remembers nothing
    for (uint s = 0u; s < counts[i]; ++s) {
        const vec4 one = memory[s * push.row + i];
        if (one.w == 0.0) continue;
        kept[touching * push.row + i] =
            uvec4(floatBitsToUint(one.xyz), contacts[s * push.row + i].other | (one.w < 0.0 ? 0x80000000u : 0u));
        ++touching;
    }
    keptCounts[i] = touching;
}

#ifdef PUBLISH
void takeBack(uint i) {
    counts[i] = keptCounts[i];
    for (uint s = 0u; s < keptCounts[i]; ++s) {
        const uvec4 one = kept[s * push.row + i];
        memory[s * push.row + i] = vec4(uintBitsToFloat(one.xyz), (one.w & 0x80000000u) != 0u ? -1.0 : 1.0);
        contacts[s * push.row + i].other = one.w & 0x7fffffffu;
    }
}

void main() {
    const uint i = itemIndex(push.count);
    if (isFinished(status)) keep(i);
    else {
        detected[i] = vec4(1e18);
        takeBack(i);
    }
}
#else
void main() { keep(itemIndex(push.count)); }
#endif
