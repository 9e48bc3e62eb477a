#version 460
// First pass of the forces on bodies: sums the impulses of the step on a run of particles of one body, and their
// moments about the first particle of the body, with positions at the end of the step.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Forces { vec4 forces[]; };
layout(std430, binding = 1) readonly buffer Positions { vec4 positions[]; }; // one per particle; w = inverse mass [1/kg]
layout(std430, binding = 2) readonly buffer Slots { uint slots[]; };        // one per particle
layout(std430, binding = 3) readonly buffer Chunks { ForceChunk chunks[]; };
layout(std430, binding = 4) writeonly buffer Parts { BodyForcePart parts[]; };
layout(push_constant) uniform Push { ForcePush push; };
layout(constant_id = 20) const uint forceSlots = 1;

vec3 impulses[FORCE_KINDS], moments[FORCE_KINDS];

void add(uint kind, uint element, float sign, vec3 x) {
    const vec3 impulse = sign * forces[element].xyz;
    impulses[kind] += impulse;
    moments[kind] += cross(x, impulse);
}

void addRows(uint kind, uint first, uint count, uint slot, vec3 x) {
    for (uint row = first; row < first + count; ++row) add(kind, (2u + 2u * row) * forceSlots + slot, 1.0, x);
}

void main() {
    const uint c = itemIndex(push.count);
    if (c >= push.count) return;
    const ForceChunk chunk = chunks[c];
    const vec3 origin = positions[chunk.origin].xyz;
    for (uint kind = 0u; kind < FORCE_KINDS; ++kind) impulses[kind] = moments[kind] = vec3(0.0);
    vec4 massMoment = vec4(0.0), places = vec4(0.0);
    for (uint p = chunk.first; p < chunk.first + chunk.count; ++p) {
        const uint slot = slots[p];
        const vec4 position = positions[p];
        const vec3 x = position.xyz - origin;
        add(FORCE_CONTACTS, slot, 1.0, x);
        add(FORCE_HOLDS, forceSlots + slot, 1.0, x);
        if (position.w == 0.0) add(FORCE_HOLDS, slot, -1.0, x); // the hold of a static particle also balances its contacts
        addRows(FORCE_GRABS, 0u, push.grabs, slot, x);
        addRows(FORCE_PLANES, push.grabs, push.planes, slot, x);
        addRows(FORCE_COLLIDERS, push.grabs + push.planes, push.colliders, slot, x);
        places += vec4(x, 1.0);
        if (position.w > 0.0) massMoment += vec4(x, 1.0) / position.w;
    }
    for (uint kind = 0u; kind < FORCE_KINDS; ++kind)
        parts[c].sums[kind] = ForceSum(vec4(impulses[kind], 0.0), vec4(moments[kind], 0.0));
    parts[c].massMoment = massMoment;
    parts[c].places = places;
}
