#version 460
// Runs in the first substep after a cut, after the lists were rebuilt: pairs whose link was cut may overlap, and
// separate at a limited speed, like pairs that overlap when a scene is loaded. Both copies of a pair get the same
// bits.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"
#include "lattice/link_ways.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer SavedLinks { uint savedLinks[]; };
layout(std430, binding = 2) readonly buffer Places { vec4 places[]; }; // at the start of the step [m]
layout(std430, binding = 3) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 4) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 5) buffer Slips { vec4 slips[]; }; // w: remaining overlap [m]

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item, dead = savedLinks[i] & ~links[i];
    if (dead == 0u) return;
    const uvec2 list = lists[i];
    for (uint slot = list.x; slot < list.x + list.y; ++slot) {
        const ContactCandidate candidate = contacts[slot];
        if ((dead & linksTo(int(candidate.other) - int(i), push.rowStride, push.sliceStride)) == 0u) continue;
        const float overlap = candidate.reach - length(places[i].xyz - places[candidate.other].xyz);
        slips[slot].w = clamp(overlap, 0.0, 0.999999 * candidate.reach); // an overlap equal to the reach would mark an interlocked pair
    }
}
