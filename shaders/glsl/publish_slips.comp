#version 460
// Ends a step for what friction remembers: saves it, or takes it back where the step is undone, as publish_memory does.
// Lists of an undone step may lack pairs: nobody is where the grid was built any more, so that it is built at once.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Status { StatusWords status; };
layout(std430, binding = 1) writeonly buffer Detected { vec4 detected[]; };
#ifdef HAS_FRICTION
layout(std430, binding = 2) buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 3) buffer Counts { uint counts[]; };
layout(std430, binding = 4) buffer Slips { vec4 slips[]; };
layout(std430, binding = 5) buffer Saved { uvec4 saved[]; }; // bits of t; the other particle
layout(std430, binding = 6) buffer SavedCounts { uint savedCounts[]; };
#endif
layout(push_constant) uniform Push { ContactPush push; };

#ifdef HAS_FRICTION
void save(uint i) {
    uint slipping = 0u;
    for (uint s = 0u; s < counts[i]; ++s) {
        const vec3 slip = slips[s * push.row + i].xyz;
        if (slip == vec3(0.0)) continue;
        saved[slipping * push.row + i] = uvec4(floatBitsToUint(slip), contacts[s * push.row + i].other);
        ++slipping;
    }
    savedCounts[i] = slipping;
}

void takeBack(uint i) {
    counts[i] = savedCounts[i];
    for (uint s = 0u; s < savedCounts[i]; ++s) {
        slips[s * push.row + i] = vec4(uintBitsToFloat(saved[s * push.row + i].xyz), 0.0);
        contacts[s * push.row + i].other = saved[s * push.row + i].w;
    }
}
#endif

void main() {
    const uint i = itemIndex(push.count);
    const bool stays = isFinished(status);
    if (!stays) detected[i] = vec4(1e18);
#ifdef HAS_FRICTION
    if (stays) save(i);
    else takeBack(i);
#endif
}
