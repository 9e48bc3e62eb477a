#version 460
// Recoils: keeps what points receive from faces in a substep (received.glsl), before contacts between particles add to it.
// Impulses of static and driven faces count along the normal, and with the velocity of the nearest point.
#extension GL_GOOGLE_include_directive : require
#define RUNS_LISTED
#include "common/kernel.glsl"
#include "common/math.glsl"
layout(std430, binding = 0) readonly buffer Lists { uvec2 lists[]; };          // by slot: first element, count
layout(std430, binding = 1) readonly buffer Directions { vec4 directions[]; }; // n; above 0 = the row counts
layout(std430, binding = 2) readonly buffer Weights { vec4 weights[]; };       // of the corners (row.glsl)
layout(std430, binding = 3) readonly buffer Impulses { vec4 impulses[]; };     // [kg m]
layout(std430, binding = 4) readonly buffer Contacts { uvec2 contacts[]; };    // ContactCandidate
layout(std430, binding = 5) readonly buffer Faces { ContactFace faces[]; };
layout(std430, binding = 6) readonly buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std430, binding = 7) readonly buffer Predicted { vec4 predicted[]; };
layout(std140, binding = 8) uniform Step { StepParams step; };
layout(push_constant) uniform Push { FacePush push; };
#define STOPS
#include "forces/forces.glsl"
#include "forces/receive.glsl"
#define TOUCHED_LIST TOUCHED_PARTICLES
#include "collision/touched.h"
#include "collision/touched.glsl"

void receiveRow(uint i, uint element) {
    const vec3 n = directions[element].xyz, impulse = impulses[element].xyz / step.h;
    const uint f = contacts[element].x;
    if (f < push.moving) {
        receive(impulse);
        return;
    }
    const ContactFace face = faces[f];
    const vec3 b = weights[element].xyz;
    const vec3 drift = b.x * velocities[face.a].xyz + b.y * velocities[face.b].xyz + b.z * velocities[face.c].xyz;
    uvec2 row = uvec2(0u);
    vec3 arm = vec3(0.0);
    if (keepsForces) {
        row = stopRows[f];
        arm = predicted[i].xyz - places[row.y].xyz;
    }
    receiveFixed(max(dot3(impulse, n), 0.0) * n, drift, rowElement(row.x, i) | isOfFace, arm);
}

void main() {
    const uint i = touchedItem();
    if (i == ~0u || velocities[i].w == 0.0) return;
    const uvec2 list = lists[i];
    for (uint element = list.x; element < list.x + list.y; ++element)
        if (directions[element].w > 0.0) receiveRow(i, element);
    storeReceived(i, 1u);
}
