#version 460
// Joins the islands of particles that touched each other in the last substep.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "contacts.glsl"
#include "islands.glsl"

layout(std430, binding = 3) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 4) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 5) readonly buffer Touching { vec4 touching[]; }; // positions with which contacts were counted [m]
layout(push_constant) uniform Push { SleepPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (!isAwake(i)) return;
    const vec3 x = touching[i].xyz;
    const uvec2 list = lists[i];
    for (uint slot = list.x; slot < list.x + list.y; ++slot) {
        const ContactCandidate candidate = contacts[slot];
        const uint j = candidate.other;
        if (j < i && isAwake(j) && touches(x - touching[j].xyz, candidate.reach)) join(i, j);
    }
}
