#version 460
// Interlocked bodies, first pass: counts the contacts with partner bodies that push a particle, by which its mass is
// divided. Removes these contacts from the ordinary passes, records their depth for update_interlocks, and copies
// velocities.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "collision/interlocks.glsl"

layout(std430, binding = 5) buffer Pairs { InterlockPair pairs[]; };
layout(std430, binding = 6) writeonly buffer Touching { vec4 touching[]; }; // x, contacts x inverse mass
layout(std430, binding = 8) readonly buffer Predicted { vec4 predicted[]; };
layout(std430, binding = 9) readonly buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std430, binding = 10) writeonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 11) buffer Slips { vec4 slips[]; }; // w: remaining overlap [m]

// Marks the pairs of a body as processed by an awake particle: 0 is none, next to 0 is no contact.
void see(uint body) {
    for (uint p = partners[body - 1u]; p < partners[body]; p += 2u) atomicMax(pairs[partners[p + 1u]].deepest, 1u);
}

// True if the candidate in a slot is a contact of a separating pair of bodies and pushes.
bool pushes(uint i, uint slot, uint pair, vec3 x, vec4 velocity) {
    const uvec2 candidate = contacts[slot];
    const float reach = uintBitsToFloat(candidate.y);
    const uint state = pairs[pair].state;
    if (slips[slot].w < 0.0) return false; // keeps its rest distance, in ordinary contacts
    // An overlap equal to the reach switches the pair off in ordinary contacts; a little less lets it recover there.
    if (state == INTERLOCK_PARTING) slips[slot] = vec4(0.0, 0.0, 0.0, reach);
    else if (state == INTERLOCK_LEFT && slips[slot].w == reach) slips[slot].w = 0.999999 * reach;
    const vec3 d = x - predicted[candidate.x].xyz;
    if (state != INTERLOCK_PARTING || !touches(d, reach)) return false;
    atomicMax(pairs[pair].deepest, floatBitsToUint(max((reach - length(d)) / reach, 1e-30)));
    const vec3 way = step.h * (velocity.xyz - velocities[candidate.x].xyz);
    return partingOf(normalOf(i, candidate.x, d), d, way, reach, step.h * push.recoverySpeed) > 0.0;
}

void main() {
    const uint i = itemIndex(push.count), body = nodes[i].body;
    const uvec2 list = body > 0u ? lists[i] : uvec2(0u);
    const vec3 x = predicted[i].xyz;
    const vec4 velocity = velocities[i];
    if (body > 0u && velocity.w > 0.0) see(body);
    float contactCount = 0.0;
    for (uint slot = list.x; slot < list.x + list.y; ++slot) {
        const uint other = nodes[contacts[slot].x].body;
        const uint pair = other > 0u ? pairOf(body, other) : noPair;
        if (pair != noPair) contactCount += float(pushes(i, slot, pair, x, velocity));
    }
    touching[i] = vec4(x, contactCount * velocity.w);
    moving[i] = velocity;
}
