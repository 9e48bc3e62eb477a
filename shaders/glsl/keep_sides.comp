#version 460
// What contacts with faces and between edges remember, put away with what they are with: before lists are made again, and, PUBLISH, when a
// step ends. A step that is undone takes it back; its lists may lack pairs, so nobody is where they were made any more.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 1) buffer Counts { uint counts[]; };
layout(std430, binding = 2) buffer Memory { vec4 memory[]; }; // t [m]; side and overlap
layout(std430, binding = 3) buffer Kept { vec4 kept[]; };
layout(std430, binding = 4) buffer KeptOthers { uint keptOthers[]; }; // the face or edge
layout(std430, binding = 5) buffer KeptCounts { uint keptCounts[]; };
#ifdef PUBLISH
layout(std430, binding = 6) readonly buffer Status { StatusWords status; };
layout(std430, binding = 7) writeonly buffer Detected { vec4 detected[]; };
layout(std430, binding = 8) buffer Bounds { GridBounds bounds; };
#endif
layout(push_constant) uniform Push { FacePush push; };

void keep(uint i) {
    uint touching = 0u; // what does not touch remembers nothing
    for (uint s = 0u; s < counts[i]; ++s) {
        const vec4 one = memory[s * push.row + i];
        if (one.w == 0.0) continue;
        kept[touching * push.row + i] = one;
        keptOthers[touching * push.row + i] = contacts[s * push.row + i].other;
        ++touching;
    }
    keptCounts[i] = touching;
}

#ifdef PUBLISH
void takeBack(uint i) {
    counts[i] = keptCounts[i];
    for (uint s = 0u; s < keptCounts[i]; ++s) {
        memory[s * push.row + i] = kept[s * push.row + i];
        contacts[s * push.row + i].other = keptOthers[s * push.row + i];
    }
}

void main() {
    const uint i = itemIndex(push.count);
    if (i == 0u && status.candidates > 0u) bounds.lacking = status.candidates;
    if (isFinished(status)) keep(i);
    else {
        detected[i] = vec4(1e18);
        takeBack(i);
    }
}
#else
void main() { keep(itemIndex(push.count)); }
#endif
