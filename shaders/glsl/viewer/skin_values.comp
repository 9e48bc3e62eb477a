#version 460
// Interpolates values of particles to the vertices of skins, by their shares.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "viewer/values.h"

layout(std430, binding = 0) readonly buffer Values { float values[]; }; // one per particle
layout(std430, binding = 1) readonly buffer Holders { ValueHolders holders[]; };
layout(std430, binding = 2) writeonly buffer SkinValues { float skinValues[]; };
layout(push_constant) uniform Push { ValuesPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const ValueHolders held = holders[i];
    float sum = 0.0, known = 0.0;
    for (uint k = 0u; k < 8u; ++k) {
        const float share = k < 4u ? held.low[k] : held.high[k & 3u], value = values[held.particles[k]];
        const float counted = value < 0.0 ? 0.0 : share;
        sum += counted * value;
        known += counted;
    }
    skinValues[i] = known > 0.0 ? sum / known : NO_VALUE;
}
