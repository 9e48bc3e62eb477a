#version 460
// Ends a step for what is remembered of contacts: saves it, or takes it back where the step is undone, as publish_memory
// does. Lists of an undone step may lack pairs: nobody is where the grid was built any more, so that it is built at once.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Status { StatusWords status; };
layout(std430, binding = 1) writeonly buffer Detected { vec4 detected[]; };
layout(std430, binding = 2) buffer Bounds { GridBounds bounds; };
#ifdef HAS_MEMORY
layout(std430, binding = 3) buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 4) buffer Counts { uint counts[]; };
layout(std430, binding = 5) buffer Slips { vec4 slips[]; };
layout(std430, binding = 6) buffer Saved { uvec4 saved[]; }; // bits of t; the other particle
layout(std430, binding = 7) buffer SavedCounts { uint savedCounts[]; };
#ifdef HAS_RECOVERY
layout(std430, binding = 8) buffer SavedOffsets { float savedOffsets[]; }; // what is left of an overlap [m]
#define OFFSET(slot) savedOffsets[slot]
#else
#define OFFSET(slot) 0.0
#endif
#endif
layout(push_constant) uniform Push { ContactPush push; };

#ifdef HAS_MEMORY
void save(uint i) {
    uint slipping = 0u;
    for (uint s = 0u; s < counts[i]; ++s) {
        const vec4 slip = slips[s * push.row + i];
        if (slip == vec4(0.0)) continue;
        const uint slot = slipping * push.row + i;
        saved[slot] = uvec4(floatBitsToUint(slip.xyz), contacts[s * push.row + i].other);
#ifdef HAS_RECOVERY
        savedOffsets[slot] = slip.w;
#endif
        ++slipping;
    }
    savedCounts[i] = slipping;
}

void takeBack(uint i) {
    counts[i] = savedCounts[i];
    for (uint s = 0u; s < savedCounts[i]; ++s) {
        const uint slot = s * push.row + i;
        slips[slot] = vec4(uintBitsToFloat(saved[slot].xyz), OFFSET(slot));
        contacts[slot].other = saved[slot].w;
    }
}
#endif

void main() {
    const uint i = itemIndex(push.count);
    const bool stays = isFinished(status);
    if (!stays) detected[i] = vec4(1e18);
    if (i == 0u && status.candidates > 0u) bounds.lacking = status.candidates;
#ifdef HAS_MEMORY
    if (stays) save(i);
    else takeBack(i);
#endif
}
