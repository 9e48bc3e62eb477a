#version 460
// Strain of each particle: root mean square of (length - rest) / rest over its live links.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "viewer/values.h"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer LinksOf { ValueLinks linksOf[]; };
layout(std430, binding = 2) readonly buffer Links { ValueLink links[]; };
layout(std430, binding = 3) readonly buffer Alive { uint alive[]; }; // by slot, link_masks.glsl
layout(std430, binding = 4) writeonly buffer Values { float values[]; };
layout(std430, binding = 5) buffer Spread { ValueSpread spread; };
layout(std430, binding = 6) readonly buffer Pieces { uint pieces[]; }; // one per particle
layout(push_constant) uniform Push { ValuesPush push; };
#include "viewer/spread.glsl"

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    if (pieces[i] == REMOVED_PIECE) {
        values[i] = NO_VALUE;
        return;
    }
    const ValueLinks own = linksOf[i];
    const uint isAlive = alive[own.slot];
    const vec3 x = positions[i].xyz;
    float squares = 0.0, found = 0.0;
    for (uint l = own.first; l < own.first + own.count; ++l) {
        const ValueLink link = links[l];
        if (link.bit != 0u && (isAlive & link.bit) == 0u) continue;
        const float strain = length(positions[link.other].xyz - x) / link.restLength - 1.0;
        squares += strain * strain;
        found += 1.0;
    }
    values[i] = found > 0.0 ? sqrt(squares / found) : NO_VALUE;
    if (found > 0.0) count(sqrt(squares / found));
}
