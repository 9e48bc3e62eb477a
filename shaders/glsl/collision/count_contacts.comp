#version 460
// Contacts, first pass: marks the particles that each one touches at its predicted position (hit_masks.glsl), and counts
// them: the number that its mass is divided by. Each that it touches counts 1 in every substep: with counts of the substep
// before, shares would add up to more than the particle, and bodies would explode. Each that it hardly misses counts less
// (weightOf in contact_reach.glsl), so that the number does not jump. In a substep with fast particles, those met on the
// way count, too.
#extension GL_GOOGLE_include_directive : require
#define MAY_RUN_LISTED
#include "common/kernel.glsl"
#include "common/contacts.glsl"

#include "common/fetched.glsl"
FETCHED_VEC4(0, Predicted, predictedAt)
FETCHED_UVEC2(1, Contacts, contactAt)   // ContactCandidate
FETCHED_VEC4(3, Velocities, velocityAt) // w = inverse mass [1/kg]
#define PREDICTED(i) predictedAt(i)
#define CONTACT(i) contactAt(i)
#define VELOCITY(i) velocityAt(i)
layout(std430, binding = 2) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 4) writeonly buffer Touching { vec4 touching[]; }; // x, contacts x inverse mass; then the time of each one's first impact, where isSwept
layout(std140, binding = 5) uniform Step { StepParams step; };
layout(std140, binding = 6) uniform Bounds { GridBounds bounds; };
#define HITS_BINDING 7
#define HITS_ACCESS
#include "common/hit_masks.glsl"
layout(constant_id = 4) const bool hasRecovery = false;
layout(std430, binding = 8) buffer Slips { vec4 slips[]; }; // w: remaining overlap [m], below 0 = keeps its rest distance
layout(constant_id = 5) const bool keepsRest = false;
layout(constant_id = 6) const bool canOpen = false; // a cut can let pairs touch
// Pairs that hardly miss count, too: in scenes of mostly loose particles. Not where pairs rebound: a rebound needs all
// of the approach taken back in the substep of the impact, and what is left of it would be given once more.
layout(constant_id = 7) const bool countsNear = true;
#define MARKS_BINDING 9
#include "collision/linked_marks.glsl"
// Recoils: candidates that touch, count or meet on the way (few_contacts.glsl). Equal at both ends of a pair.
layout(std430, binding = 10) writeonly buffer Near { uvec2 near[]; };
#include "forces/received.glsl"
layout(push_constant) uniform Push { ContactPush push; };

#include "collision/contact_reach.glsl"
#include "common/few_contacts.glsl"

uint nearMask = 0u, firstSlot; // of 32 candidates

void addNear(uint slot) {
    if (keepsReceived) nearMask |= 1u << slot - firstSlot;
}

void addWeight(uint slot, float weight, inout float weights) {
    weights += weight;
    if (weight > 0.0) addNear(slot);
}

// Whether particle i, at x, touches the candidate in a slot at the end of the substep. Adds the weight of a candidate that
// it does not touch to `weights`: in the order of the list, so that no candidate beyond the band changes the sum.
bool touchesAtEnd(uint slot, vec3 x, vec3 velocity, inout float weights) {
    const uvec2 candidate = CONTACT(slot);
    const vec3 d = x - PREDICTED(candidate.x).xyz;
    const float reach = reachOf(slot, uintBitsToFloat(candidate.y));
    const bool isTouching = touches(d, reach) || hasPassed(slot, d, velocity);
    if (countsNear) addWeight(slot, isTouching ? 0.0 : weightOf(slot, d, reach), weights);
    return isTouching;
}

// The same in a substep with fast particles. `first`: when it first met another.
bool touchesOnWay(uint slot, vec4 x, vec3 velocity, float first, inout float weights) {
    const Pair pair = pairOf(slot, x, velocity);
    const Contact contact = contactOf(pair.d, pair.way, pair.reach, first, pair.areFree);
    const bool isTouching = contact.exists || !contact.isMet && hasPassed(slot, pair.d, velocity);
    if (countsNear) addWeight(slot, isTouching || contact.isMet ? 0.0 : weightOf(slot, pair.d, pair.reach), weights);
    if (contact.isMet) addNear(slot); // for both, while `exists` regards what each has met first
    return isTouching;
}

bool isDriven(vec4 velocity) { return velocity.w == 0.0 && velocity.xyz != vec3(0.0); }
vec3 drivenVelocityOf(vec4 velocity) { return isDriven(velocity) ? velocity.xyz : vec3(0.0); }

void main() {
    const uint i = itemIndex(push.count);
    if (isPadding(bounds.listed)) return;
    const uvec2 list = lists[i];
    const uint end = list.x + list.y;
    uvec2 few = uvec2(0u);
    // Loops of which some are empty: on a software device, code under a condition costs its time even if it does not
    // run.
    const bool isSwept = bounds.isSwept != 0u;
    const uint sweeping = isSwept ? end : list.x;
    const vec4 start = PREDICTED(i);
    vec3 x = start.xyz, drive = vec3(0.0); // drive: velocity of a driven particle that it met first
    const vec4 velocity = VELOCITY(i);
    float contactCount = 0.0, weights = 0.0, first = 1.0;
    if (hasRecovery)
        for (uint slot = list.x; slot < end; ++slot) recover(i, slot, x);
    for (uint slot = list.x; slot < sweeping; ++slot) {
        const Pair pair = pairOf(slot, start, velocity.xyz);
        const float time = meetingOf(pair.d, pair.way, pair.reach, pair.areFree).time;
        if (time < first) drive = drivenVelocityOf(VELOCITY(CONTACT(slot).x));
        first = min(first, time);
    }
    if (isDriven(velocity)) first = 1.0; // nothing stops it
    for (uint word = 0u; word < wordsOf(list); ++word) {
        const uint from = list.x + 32u * word, to = min(from + 32u, end);
        uint hit = 0u;
        nearMask = 0u;
        firstSlot = from;
        for (uint slot = from; slot < (isSwept ? from : to); ++slot)
            hit |= uint(touchesAtEnd(slot, x, velocity.xyz, weights)) << slot - from;
        for (uint slot = from; slot < (isSwept ? to : from); ++slot)
            hit |= uint(touchesOnWay(slot, start, velocity.xyz, first, weights)) << slot - from;
        contactCount += float(bitCount(hit));
        if (keepsReceived) addPlaces(few, nearMask | hit, 32u * word);
        const uint place = hitWord(push.count, i, list, word);
        hits[place] = uvec2(hit, hits[place].x & ~hit);
    }
    if (sweeping > list.x) {
        touching[push.count + i] = vec4(first);
        if (first < 1.0) x -= (1.0 - first) * step.h * (velocity.xyz - drive); // stays at the point of impact
    }
    clearReceivedGroups();
    if (keepsReceived) near[i] = few;
    touching[i] = vec4(x, (contactCount + weights) * velocity.w);
}
