#version 460
// Contacts with faces and between edges, second pass: sums the contact weights of a particle. Each row gets the share
// |beta| / S of the particle's mass, S = the sum of |beta| over all of its rows: shares sum to 1. Written here: S w.
#extension GL_GOOGLE_include_directive : require
#define RUNS_LISTED
#include "common/kernel.glsl"
#include "collision/rows_of.glsl"
layout(constant_id = 1) const bool ofRebounds = false; // sums rows that rebound alone; else the next buffer is empty
layout(std430, binding = 9) readonly buffer Impulses { vec4 impulses[]; }; // w: speed of a rebound [m/s]
#define TOUCHED_LIST TOUCHED_PARTICLES
#include "collision/touched.h"
#include "collision/touched.glsl"
layout(std430, binding = 7) readonly buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std430, binding = 8) writeonly buffer Shares { float shares[]; };       // S w [1/kg]

float sum = 0.0;
void visit(uint element, uint place) {
    if (DIRECTION(element).w > 0.0 && (!ofRebounds || impulses[element].w > 0.0)) sum += abs(betaOf(element, place));
}

void main() {
    const uint i = touchedItem();
    if (i == ~0u) return;
    visitRows(i);
    shares[i] = sum * velocities[i].w;
}
