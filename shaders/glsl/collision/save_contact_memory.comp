#version 460
// Saves contact memory before lists of particles are rebuilt.
#extension GL_GOOGLE_include_directive : require
#define MAY_RUN_LISTED
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 1) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 2) readonly buffer Memory { vec4 memory[]; };
layout(std430, binding = 3) writeonly buffer Kept { vec4 kept[]; };
layout(std430, binding = 4) writeonly buffer KeptOthers { uint keptOthers[]; };
layout(std430, binding = 5) writeonly buffer KeptLists { uvec2 keptLists[]; };
layout(push_constant) uniform Push { CountPush push; };
#include "collision/keep_list.glsl"

void main() {
    const uint i = itemIndex(push.count);
    keptLists[i] = keep(lists[i]);
}
