#version 460
// Restitution of contacts with faces and between edges, third pass: the impulse that makes the two sides separate at
// the required speed,
//
//   l = (speed - n . v) / D >= 0,   D = sum_k |beta_k| S_k w_k over contacts that rebound (row_contacts.hpp).
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Velocities { vec4 velocities[]; }; // after all contacts of the substep
layout(std430, binding = 2) readonly buffer Contacts { uvec2 contacts[]; };
layout(std430, binding = 3) readonly buffer Owners { uint owners[]; };      // one per element
layout(std430, binding = 4) readonly buffer Directions { vec4 directions[]; };
layout(std430, binding = 5) readonly buffer Weights { vec4 weights[]; };
layout(std430, binding = 6) readonly buffer Shares { float shares[]; };
layout(std430, binding = 7) buffer Impulses { vec4 impulses[]; }; // [kg m/s]; w: speed [m/s], 0 = does not rebound
layout(std430, binding = 8) readonly buffer Touched { uint touched[]; };
#define VELOCITY(i) velocities[i]
#define WEIGHT(k) weights[k]
#include "collision/touched.h"
#include "collision/touched.glsl"
layout(push_constant) uniform Push { FacePush push; };
#define SHAPES_BINDING 1
#include "collision/row.glsl"

vec3 impulseOf(uint owner, uint element) {
    const Row row = rowOf(owner, contacts[element].x, weights[element]);
    const vec3 n = directions[element].xyz;
    const float D = SHARED(row, shares);
    return D > 0.0 ? max(0.0, impulses[element].w - dot(n, BETWEEN(row, VELOCITY))) / D * n : vec3(0.0);
}

void main() {
    FOR_EACH_TOUCHED_ROW(row) {
        const uint element = touchedRow(row);
        if (directions[element].w > 0.0 && impulses[element].w > 0.0) impulses[element].xyz = impulseOf(owners[element], element);
    }
}
