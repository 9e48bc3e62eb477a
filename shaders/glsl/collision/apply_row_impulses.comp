#version 460
// Contacts with faces and between edges, last pass: moves a particle by all of its rows at once, x_i += w_i sum
// beta_ic l_c n_c. Momentum is exact to rounding, for an impulse has the same bits wherever it is read. Changes
// predicted positions and velocities in place. Impulses on static faces are added from their points, since these faces have
// no lists of points. REBOUND: changes velocities by the impulses [kg m/s] of rows that rebound, after all contacts of a
// substep.
#extension GL_GOOGLE_include_directive : require
#define RUNS_LISTED
#include "common/kernel.glsl"
#include "common/remainder.glsl"
#include "collision/rows_of.glsl"
#define TOUCHED_LIST TOUCHED_PARTICLES
#include "collision/touched.h"
#include "collision/touched.glsl"
#include "common/fetched.glsl"
FETCHED_VEC4(7, Impulses, impulseAt) // [kg m]; REBOUND: [kg m/s], w: speed of the rebound, 0 = none
#define IMPULSE(k) impulseAt(k)
#ifdef REBOUND
layout(std430, binding = 8) buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std430, binding = 9) buffer State { vec4 state[]; };       // x + thetaH v
layout(std140, binding = 10) uniform Step { StepParams step; };
#else
layout(std430, binding = 8) buffer Velocities { vec4 velocities[]; };   // w = inverse mass [1/kg]
layout(std430, binding = 9) buffer Predicted { vec4 predicted[]; }; // remainder.glsl
layout(std140, binding = 10) uniform Step { StepParams step; };
#endif

#define STOPS
#include "forces/forces.glsl"
layout(std430, binding = FORCES_BINDING + 3) readonly buffer Contacts { uvec2 contacts[]; }; // ContactCandidate

bool counts(uint element) {
#ifdef REBOUND
    return DIRECTION(element).w > 0.0 && IMPULSE(element).w > 0.0;
#else
    return DIRECTION(element).w > 0.0;
#endif
}

vec3 sum = vec3(0.0);
void visit(uint element, uint place) {
    if (counts(element)) sum += betaOf(element, place) * IMPULSE(element).xyz;
}

vec3 impulseOn(uint i) {
    visitRows(i);
    return sum;
}

// Adds the impulses on static faces from particle i at x: `scale` times the impulses of its contacts.
void addStopForces(uint i, float scale, vec3 x) {
    const uvec2 list = keepsForces && !areEdges ? lists[i] : uvec2(0u);
    for (uint element = list.x; element < list.x + list.y; ++element)
        if (contacts[element].x >= push.moving && counts(element))
            addStopForce(contacts[element].x, i, scale * IMPULSE(element).xyz, x);
}

#ifdef REBOUND
void main() {
    const uint i = touchedItem();
    if (i == ~0u) return;
    const vec3 impulse = impulseOn(i), change = velocities[i].w * impulse;
    addContactForce(i, impulse);
    addStopForces(i, 1.0, state[i].xyz - step.thetaH * velocities[i].xyz);
    velocities[i].xyz += change;
    state[i].xyz += step.thetaH * change;
}
#else
void main() {
    const uint i = touchedItem();
    if (i == ~0u) return;
    const vec3 x = predicted[i].xyz, impulse = impulseOn(i), correction = velocities[i].w * impulse;
    addContactForce(i, impulse / step.h);
    addStopForces(i, 1.0 / step.h, x);
    predicted[i].xyz = x + correction;
    velocities[i].xyz += correction / step.h;
    if (!hasRemainders) return;
    const uint r = remainderOf(predicted.length(), i);
    const Sum sum = exactSum(x, predicted[r].xyz + correction);
    predicted[i].xyz = sum.rounded;
    predicted[r] = vec4(sum.remainder, 0.0);
}
#endif
