#version 460
// Restitution between particles, first pass: counts the bounces of a particle, by which its mass is divided.
#extension GL_GOOGLE_include_directive : require
#define MAY_RUN_LISTED
#include "common/kernel.glsl"
#include "common/contacts.glsl"
#include "collision/bounces.glsl"
layout(std430, binding = BOUNCE_BINDING) readonly buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std430, binding = BOUNCE_BINDING + 1) writeonly buffer Bouncing { float bouncing[]; }; // bounces x inverse mass

void main() {
    const uint i = itemIndex(push.count);
    const uvec2 list = lists[i];
    const Self self = selfOf(i);
    float bounces = 0.0;
    for (uint word = 0u; word < wordsOf(list); ++word)
        for (uint at = hits[hitWord(push.count, i, list, word)].x; at != 0u; at &= at - 1u)
            bounces += float(bounceFrom(i, list.x + 32u * word + findLSB(at), self).speed > 0.0);
    bouncing[i] = bounces * velocities[i].w;
}
