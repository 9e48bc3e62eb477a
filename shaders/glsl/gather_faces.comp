#version 460
// Contacts with faces, last pass: a particle is moved by all of its contacts at once, x_i += w_i sum beta_ic l_c n_c, as a
// point and as a corner. Momentum is exact to rounding, for impulses are the same bits wherever they are read.
// Predicted positions and velocities are changed where they stand, of groups in which somebody has a candidate. EDGES: as an
// end of edges, whose impulses are summed up already. FORCES: what a point gets of faces that never move is also theirs; these know no points. REBOUND: what velocities get of impulses [kg m/s] after all contacts of a substep.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "remainder.glsl"
#ifdef EDGES
layout(std430, binding = 0) readonly buffer Corners { uint corners[]; };   // first of each particle; then 2 x edge + end
layout(std430, binding = 1) readonly buffer Impulses { vec4 impulses[]; }; // on each end of all edges [kg m]
layout(push_constant) uniform Push { FacePush push; };
#define STATE_BINDING 2
#else
#include "face_shares.glsl"
layout(std430, binding = 7) readonly buffer Impulses { vec4 impulses[]; };   // [kg m]
#define STATE_BINDING 8
#endif
#ifdef REBOUND
layout(std430, binding = STATE_BINDING) buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std430, binding = STATE_BINDING + 1) buffer State { vec4 state[]; };       // x + thetaH v
layout(std140, binding = STATE_BINDING + 2) uniform Step { StepParams step; };
#else
layout(std430, binding = STATE_BINDING) buffer Velocities { vec4 velocities[]; };   // w = inverse mass [1/kg]
layout(std430, binding = STATE_BINDING + 1) buffer Predicted { vec4 predicted[]; }; // remainder.glsl
layout(std140, binding = STATE_BINDING + 2) uniform Step { StepParams step; };
#endif

#define FORCES_BINDING (STATE_BINDING + 3)
#ifndef EDGES
#define STOPS
#endif
#include "forces.glsl"
#if defined FORCES && defined STOPS
layout(std430, binding = FORCES_BINDING + 3) readonly buffer Contacts { uvec2 contacts[]; }; // ContactCandidate
#endif
#include "face_impulses.glsl"

#ifdef FORCES
// Adds what faces that never move give to particle i at x: `scale` times the impulses.
void addStopForces(uint i, float scale, vec3 x) {
#ifdef STOPS
    const uvec2 list = lists[i];
    for (uint element = list.x; element < list.x + list.y; ++element)
        if (contacts[element].x >= push.moving && directions[element].w > 0.0)
            addStopForce(contacts[element].x, i, scale * impulses[element].xyz, x);
#endif
}
#endif

#ifdef REBOUND
void main() {
    const uint i = itemIndex(push.count);
    const vec3 impulse = impulseOn(i), change = velocities[i].w * impulse;
#ifdef FORCES
    addContactForce(i, impulse);
    addStopForces(i, 1.0, state[i].xyz - step.thetaH * velocities[i].xyz);
#endif
    velocities[i].xyz += change;
    state[i].xyz += step.thetaH * change;
}
#else
void main() {
    const uint i = itemIndex(push.count);
    const vec3 x = predicted[i].xyz, impulse = impulseOn(i), correction = velocities[i].w * impulse;
#ifdef FORCES
    addContactForce(i, impulse / step.h);
    addStopForces(i, 1.0 / step.h, x);
#endif
    predicted[i].xyz = x + correction;
    velocities[i].xyz += correction / step.h;
    if (!hasRemainders) return;
    const uint r = remainderOf(predicted.length(), i);
    const Sum sum = exactSum(x, predicted[r].xyz + correction);
    predicted[i].xyz = sum.rounded;
    predicted[r] = vec4(sum.remainder, 0.0);
}
#endif
