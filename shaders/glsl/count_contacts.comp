#version 460
// Contacts, first pass: counts the contacts of a particle at its predicted position, by which its mass is divided.
// Counted exactly in every substep: with counts of the substep before, shares add up to more than the whole particle
// and bodies explode. In a substep with fast particles, impacts on the way count too.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "contacts.glsl"

#ifdef TEXELS
layout(binding = 0) uniform samplerBuffer predicted;
layout(binding = 1) uniform usamplerBuffer contacts;
layout(binding = 3) uniform samplerBuffer velocities;
#define PREDICTED(i) texelFetch(predicted, int(i))
#define CONTACT(i) texelFetch(contacts, int(i)).xy
#define VELOCITY(i) texelFetch(velocities, int(i))
#else
layout(std430, binding = 0) readonly buffer Predicted { vec4 predicted[]; };
layout(std430, binding = 1) readonly buffer Contacts { uvec2 contacts[]; }; // ContactCandidate, in one load
layout(std430, binding = 3) readonly buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
#define PREDICTED(i) predicted[i]
#define CONTACT(i) contacts[i]
#define VELOCITY(i) velocities[i]
#endif
layout(std430, binding = 2) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 4) writeonly buffer Touching { vec4 touching[]; }; // x, contacts x inverse mass
layout(std140, binding = 5) uniform Step { StepParams step; };
layout(std140, binding = 6) uniform Bounds { GridBounds bounds; };
layout(std430, binding = 7) writeonly buffer Firsts { float firsts[]; }; // time of each particle's first impact; only if isSwept
#ifdef HAS_RECOVERY
layout(std430, binding = 8) buffer Slips { vec4 slips[]; }; // w: remaining overlap [m], below 0 = keeps its rest distance
layout(constant_id = 5) const bool keepsRest = false;
layout(constant_id = 6) const bool canOpen = false; // a cut can let pairs touch
#define MARKS_BINDING 9
#include "linked_marks.glsl"
#endif
layout(push_constant) uniform Push { ContactPush push; };

#include "contact_reach.glsl"

void main() {
    const uint i = itemIndex(push.count);
    const uvec2 list = lists[i];
    const uint end = list.x + list.y;
    // Loops of which some are empty: on a software device, code under a condition costs its time even if it does not
    // run.
    const uint resting = bounds.isSwept != 0u ? list.x : end, sweeping = bounds.isSwept != 0u ? end : list.x;
    const vec4 start = PREDICTED(i);
    vec3 x = start.xyz;
    const vec4 velocity = VELOCITY(i);
    float contactCount = 0.0, first = 1.0;
#ifdef HAS_RECOVERY
    for (uint slot = list.x; slot < end; ++slot) recover(i, slot, x);
#endif
    for (uint slot = list.x; slot < resting; ++slot) {
        const uvec2 candidate = CONTACT(slot);
        const vec3 d = x - PREDICTED(candidate.x).xyz;
        contactCount += float(touches(d, reachOf(slot, uintBitsToFloat(candidate.y))) || hasPassed(slot, d, velocity.xyz));
    }
    for (uint slot = list.x; slot < sweeping; ++slot) {
        const Pair pair = pairOf(slot, start, velocity.xyz);
        first = min(first, meetingOf(pair.d, pair.way, pair.reach, pair.areFree).time);
    }
    for (uint slot = list.x; slot < sweeping; ++slot) {
        const Pair pair = pairOf(slot, start, velocity.xyz);
        const Contact contact = contactOf(pair.d, pair.way, pair.reach, first, pair.areFree);
        contactCount += float(contact.exists || !contact.isMet && hasPassed(slot, pair.d, velocity.xyz));
    }
    if (sweeping > list.x) {
        firsts[i] = first;
        if (first < 1.0) x -= (1.0 - first) * step.h * velocity.xyz; // stays at the point of impact
    }
    touching[i] = vec4(x, contactCount * velocity.w);
}
