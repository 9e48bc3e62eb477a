#version 460
// Speed of each particle.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "viewer/values.h"

layout(std430, binding = 0) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 1) writeonly buffer Values { float values[]; };
layout(std430, binding = 2) buffer Spread { ValueSpread spread; };
layout(std430, binding = 3) readonly buffer Pieces { uint pieces[]; }; // one per particle
layout(push_constant) uniform Push { ValuesPush push; };
#include "viewer/spread.glsl"

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    if (pieces[i] == REMOVED_PIECE) {
        values[i] = NO_VALUE;
        return;
    }
    const float speed = length(velocities[i].xyz);
    values[i] = speed;
    count(speed);
}
