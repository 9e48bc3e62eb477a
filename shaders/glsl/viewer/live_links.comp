#version 460
// Writes the ends of links, two indices each; for dead or removed links the same index twice, which draws nothing.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "viewer/values.h"

layout(std430, binding = 0) readonly buffer Links { LineLink links[]; };
layout(std430, binding = 1) readonly buffer Alive { uint alive[]; }; // by slot, link_masks.glsl
layout(std430, binding = 2) writeonly buffer Indices { uint indices[]; };
layout(std430, binding = 3) readonly buffer Pieces { uint pieces[]; }; // one per particle
layout(push_constant) uniform Push { ValuesPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const LineLink link = links[i];
    const bool isGone = pieces[link.a] == REMOVED_PIECE;
    const bool isCut = (alive[link.slot] & link.bit) != link.bit || (alive[link.overSlot] & link.overBit) != link.overBit;
    indices[2u * i] = link.a;
    indices[2u * i + 1u] = isGone || isCut ? link.a : link.b;
}
