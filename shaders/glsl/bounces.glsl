// What the two passes of restitution between particles share: which contacts of a substep rebound, and how. Newton's law
// against the velocities before the substep; impacts slower than step.restSpeed do not rebound, or resting contacts would
// tremble (contacts: 5).
#ifdef TEXELS
layout(binding = 0) uniform samplerBuffer touching;
layout(binding = 1) uniform usamplerBuffer contacts;
layout(binding = 2) uniform samplerBuffer before;
#define TOUCHING(i) texelFetch(touching, int(i)).xyz
#define CONTACT(i) texelFetch(contacts, int(i)).xy
#define BEFORE(i) texelFetch(before, int(i)).xyz
#else
layout(std430, binding = 0) readonly buffer Touching { vec4 touching[]; };  // x of what the contacts were found from
layout(std430, binding = 1) readonly buffer Contacts { uvec2 contacts[]; }; // ContactCandidate, in one load
layout(std430, binding = 2) readonly buffer Before { vec4 before[]; };      // velocities before the substep [m/s]
#define TOUCHING(i) touching[i].xyz
#define CONTACT(i) contacts[i]
#define BEFORE(i) before[i].xyz
#endif
layout(std430, binding = 3) readonly buffer Counts { uint counts[]; };
layout(std140, binding = 4) uniform Step { StepParams step; };
#ifdef HAS_SURFACES
layout(std430, binding = 5) readonly buffer Surfaces { uint surfaces[]; }; // of each particle
layout(std430, binding = 6) readonly buffer Pairs { SurfacePair pairs[]; };
#define RESTITUTION(i, j) pairs[surfaces[i] * push.surfaces + surfaces[j]].restitution
#define BOUNCE_BINDING 7
#else
#define RESTITUTION(i, j) push.restitution
#define BOUNCE_BINDING 5
#endif
layout(push_constant) uniform Push { ContactPush push; };

// Of particle i from the candidate.
struct Bounce {
    vec3 n;      // unit, from the other to i
    float speed; // at which the two must part [m/s]; 0 = they do not rebound
};

Bounce bounceFrom(uint i, uvec2 candidate, vec3 x, vec3 velocityBefore) {
    const vec3 d = x - TOUCHING(candidate.x);
    Bounce bounce = Bounce(vec3(0.0), 0.0);
    if (!touches(d, uintBitsToFloat(candidate.y))) return bounce;
    bounce.n = directionOf(d, i, candidate.x).n;
    precise float speed = dot(bounce.n, velocityBefore - BEFORE(candidate.x));
    if (speed < -step.restSpeed) bounce.speed = -RESTITUTION(i, candidate.x) * speed;
    return bounce;
}
