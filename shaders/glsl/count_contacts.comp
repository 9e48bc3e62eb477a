#version 460
// Contacts, first pass: how many others a particle touches where the substep has taken it, which is what it is divided by.
// Counted exactly in every substep: with counts of the one before, shares add up to more than the whole particle and
// bodies explode (contacts: 1).
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "contacts.glsl"

#ifdef TEXELS
layout(binding = 0) uniform samplerBuffer predicted;
layout(binding = 1) uniform usamplerBuffer contacts;
#define PREDICTED(i) texelFetch(predicted, int(i))
#define CONTACT(i) texelFetch(contacts, int(i)).xy
#else
layout(std430, binding = 0) readonly buffer Predicted { vec4 predicted[]; };
layout(std430, binding = 1) readonly buffer Contacts { uvec2 contacts[]; }; // ContactCandidate, in one load
#define PREDICTED(i) predicted[i]
#define CONTACT(i) contacts[i]
#endif
layout(std430, binding = 2) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 3) readonly buffer Velocities { vec4 velocities[]; };  // w = inverse mass [1/kg]
layout(std430, binding = 4) writeonly buffer Touching { vec4 touching[]; };     // x, contacts x inverse mass
#ifdef HAS_RECOVERY
layout(std430, binding = 5) buffer Slips { vec4 slips[]; }; // w: what is left of an overlap [m]
layout(std140, binding = 6) uniform Step { StepParams step; };
#endif
layout(push_constant) uniform Push { ContactPush push; };

// Where the candidate in `slot` is touched, at difference d.
float reachOf(uint slot, float reach, vec3 d) {
#ifdef HAS_RECOVERY
    const float before = slips[slot].w;
    if (before == 0.0) return reach;
    const float offset = recovering(before, push.recoverySpeed * step.h, reach - length(d));
    slips[slot].w = offset;
    return reach - offset;
#else
    return reach;
#endif
}

void main() {
    const uint i = itemIndex(push.count), n = counts[i];
    const vec3 x = PREDICTED(i).xyz;
    float contactCount = 0.0;
    for (uint s = 0u; s < n; ++s) {
        const uint slot = s * push.row + i;
        const uvec2 candidate = CONTACT(slot);
        const vec3 d = x - PREDICTED(candidate.x).xyz;
        contactCount += float(touches(d, reachOf(slot, uintBitsToFloat(candidate.y), d)));
    }
    touching[i] = vec4(x, contactCount * velocities[i].w);
}
