// Shared by the two passes of restitution between particles: the contacts of a substep that rebound, and their
// speeds. Newton's law against the velocities before the substep; impacts slower than step.restSpeed do not rebound,
// or resting contacts would tremble.
#include "common/fetched.glsl"
FETCHED_VEC4(0, Positions, positionAt)  // used to find contacts
FETCHED_UVEC2(1, Contacts, contactAt)   // ContactCandidate
FETCHED_VEC4(2, Before, beforeAt)       // velocities before the substep [m/s]
FETCHED_VEC4(3, Predicted, predictedAt) // velocities used to find contacts
#define POSITION(i) positionAt(i)
#define CONTACT(i) contactAt(i)
#define BEFORE(i) beforeAt(i).xyz
#define PREDICTED(i) predictedAt(i).xyz
layout(std430, binding = 4) readonly buffer Lists { uvec2 lists[]; };
layout(std140, binding = 5) uniform Step { StepParams step; };
layout(std140, binding = 6) uniform Bounds { GridBounds bounds; };
FETCHED_VEC4(7, Touching, touchingAt) // count_contacts; behind all: time of each particle's first impact, where isSwept
#define FIRST_IMPACT(i) touchingAt(push.count + (i)).x
layout(std430, binding = 8) readonly buffer Surfaces { uint surfaces[]; }; // one per particle
layout(std430, binding = 9) readonly buffer Pairs { SurfacePair pairs[]; };
#define HITS_BINDING 10
#include "common/hit_masks.glsl"
#define SLIPS_BINDING (HITS_BINDING + 1)
layout(std430, binding = SLIPS_BINDING) readonly buffer Slips { vec4 slips[]; }; // see contact_memory.glsl; used by contacts that keep a rest distance
#define BOUNCE_BINDING (SLIPS_BINDING + 1)
layout(constant_id = 5) const bool keepsRest = false;
layout(constant_id = 7) const bool hasSurfaces = false; // pairs differ
layout(push_constant) uniform Push { ContactPush push; };

float restitutionOf(uint i, uint j) {
    if (!hasSurfaces) return push.restitution;
    return pairs[surfaces[i] * push.surfaces + surfaces[j]].restitution;
}

// State of particle i.
struct Self {
    vec4 x;
    vec3 before, predicted;
};

Self selfOf(uint i) { return Self(POSITION(i), BEFORE(i), PREDICTED(i)); }

// Bounce of particle i from a candidate.
struct Bounce {
    vec3 n;      // unit, from the other to i
    float speed; // at which the two must part [m/s]; 0 = they do not rebound
};

// From a marked candidate.
Bounce bounceFrom(uint i, uint slot, Self self) {
    const uvec2 candidate = CONTACT(slot);
    const uint j = candidate.x;
    const vec4 xj = POSITION(j);
    const vec3 d = self.x.xyz - xj.xyz, change = self.before - BEFORE(j);
    const vec3 way = step.h * (self.predicted - PREDICTED(j));
    const float reach = uintBitsToFloat(candidate.y) - (keepsRest ? nearerBy(slips[slot].w) : 0.0);
    Contact contact = Contact(true, false, d);
    if (bounds.isSwept != 0u)
        contact = contactOf(d, way, reach, min(FIRST_IMPACT(i), FIRST_IMPACT(j)), areFreeOf(self.x.w, xj.w));
    const bool hasPassed = keepsRest && !contact.isMet && isKept(slips[slot].w) && reach > 0.0 && passes(d, way);
    Bounce bounce = Bounce(vec3(0.0), 0.0);
    if (!contact.exists && !hasPassed) return bounce;
    bounce.n = hasPassed ? passedDirection(d, way).n : directionOf(contact.at, i, j).n;
    const float speed = dot3(bounce.n, change), rebound = -restitutionOf(i, j) * speed;
    if (speed < -step.restSpeed) bounce.speed = rebound;
    return bounce;
}
