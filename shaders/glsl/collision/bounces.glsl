// Shared by the two passes of restitution between particles: the contacts of a substep that rebound, and their
// speeds. Newton's law against the velocities before the substep; impacts slower than step.restSpeed do not rebound,
// or resting contacts would tremble.
#ifdef TEXELS
layout(binding = 0) uniform samplerBuffer positions;
layout(binding = 1) uniform usamplerBuffer contacts;
layout(binding = 2) uniform samplerBuffer before;
layout(binding = 3) uniform samplerBuffer predicted;
#define POSITION(i) texelFetch(positions, int(i))
#define CONTACT(i) texelFetch(contacts, int(i)).xy
#define BEFORE(i) texelFetch(before, int(i)).xyz
#define PREDICTED(i) texelFetch(predicted, int(i)).xyz
#else
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; }; // used to find contacts
layout(std430, binding = 1) readonly buffer Contacts { uvec2 contacts[]; }; // ContactCandidate, in one load
layout(std430, binding = 2) readonly buffer Before { vec4 before[]; };      // velocities before the substep [m/s]
#define POSITION(i) positions[i]
#define CONTACT(i) contacts[i]
layout(std430, binding = 3) readonly buffer Predicted { vec4 predicted[]; }; // velocities used to find contacts
#define BEFORE(i) before[i].xyz
#define PREDICTED(i) predicted[i].xyz
#endif
layout(std430, binding = 4) readonly buffer Lists { uvec2 lists[]; };
layout(std140, binding = 5) uniform Step { StepParams step; };
layout(std140, binding = 6) uniform Bounds { GridBounds bounds; };
layout(std430, binding = 7) readonly buffer Firsts { float firsts[]; }; // time of each particle's first contact, where isSwept
#ifdef HAS_SURFACES
layout(std430, binding = 8) readonly buffer Surfaces { uint surfaces[]; }; // one per particle
layout(std430, binding = 9) readonly buffer Pairs { SurfacePair pairs[]; };
#define RESTITUTION(i, j) pairs[surfaces[i] * push.surfaces + surfaces[j]].restitution
#define HITS_BINDING 10
#else
#define RESTITUTION(i, j) push.restitution
#define HITS_BINDING 8
#endif
#include "common/hit_masks.glsl"
#define SLIPS_BINDING (HITS_BINDING + 1)
layout(std430, binding = SLIPS_BINDING) readonly buffer Slips { vec4 slips[]; }; // see contact_memory.glsl; used by contacts that keep a rest distance
#define BOUNCE_BINDING (SLIPS_BINDING + 1)
layout(constant_id = 5) const bool keepsRest = false;
layout(push_constant) uniform Push { ContactPush push; };

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
        contact = contactOf(d, way, reach, min(firsts[i], firsts[j]), areFreeOf(self.x.w, xj.w));
    const bool hasPassed = keepsRest && !contact.isMet && isKept(slips[slot].w) && reach > 0.0 && passes(d, way);
    Bounce bounce = Bounce(vec3(0.0), 0.0);
    if (!contact.exists && !hasPassed) return bounce;
    bounce.n = hasPassed ? passedDirection(d, way).n : directionOf(contact.at, i, j).n;
    const float speed = dot3(bounce.n, change), rebound = -RESTITUTION(i, j) * speed;
    if (speed < -step.restSpeed) bounce.speed = rebound;
    return bounce;
}
