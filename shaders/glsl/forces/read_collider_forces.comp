#version 460
// The impulses on many colliders as parts of their rows: reads the whole numbers that solve_colliders has summed.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer ColliderForces { ColliderForce colliderForces[]; };
layout(std430, binding = 1) writeonly buffer Parts { ForceSum parts[]; };
layout(push_constant) uniform Push { ColliderForcePush push; };

float read(uint c, uint component) {
    uint low = colliderForces[c].words[2u * component], high = colliderForces[c].words[2u * component + 1u];
    const bool isBelow = (high & 0x80000000u) != 0u;
    if (isBelow) {
        low = ~low + 1u;
        high = ~high + (low == 0u ? 1u : 0u);
    }
    const float size = push.unit * (4294967296.0 * float(high) + float(low));
    return isBelow ? -size : size;
}

void main() {
    const uint c = itemIndex(push.count);
    if (c >= push.count) return;
    parts[push.firstPart + c] = ForceSum(vec4(read(c, 0u), read(c, 1u), read(c, 2u), 0.0),
                                         vec4(read(c, 3u), read(c, 4u), read(c, 5u), 0.0));
}
