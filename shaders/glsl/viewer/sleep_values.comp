#version 460
// Sleep state of each particle: 1 = awake, 0 = asleep, none = static. The public inverse mass of a sleeping particle
// is 0.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "viewer/values.h"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Masses { float inverseMasses[]; };
layout(std430, binding = 2) writeonly buffer Values { float values[]; };
layout(std430, binding = 3) buffer Spread { ValueSpread spread; };
layout(std430, binding = 4) readonly buffer Pieces { uint pieces[]; }; // one per particle
layout(push_constant) uniform Push { ValuesPush push; };
#include "viewer/spread.glsl"

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    if (pieces[i] == REMOVED_PIECE) {
        values[i] = NO_VALUE;
        return;
    }
    const bool isFixed = inverseMasses[i] == 0.0;
    const float value = positions[i].w > 0.0 ? 1.0 : 0.0;
    values[i] = isFixed ? NO_VALUE : value;
    if (!isFixed) count(value);
}
