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
layout(std430, binding = 4) readonly buffer Bounces { vec4 bounces[]; };
layout(std430, binding = 5) readonly buffer Weights { vec4 weights[]; };
layout(std430, binding = 6) readonly buffer Shares { float shares[]; };
layout(std430, binding = 7) writeonly buffer Impulses { vec4 impulses[]; };    // [kg m/s]
layout(std140, binding = 8) uniform Bounds { GridBounds bounds; };
#define VELOCITY(i) velocities[i]
#define WEIGHT(k) weights[k]
#include "collision/row_items.glsl"
layout(push_constant) uniform Push { FacePush push; };
#define SHAPES_BINDING 1
#include "collision/row.glsl"

vec3 impulseOf(uint owner, uint element) {
    const Row row = rowOf(owner, contacts[element].x, weights[element]);
    const vec4 bounce = bounces[element];
    const float D = SHARED(row, shares);
    return D > 0.0 ? max(0.0, bounce.w - dot(bounce.xyz, BETWEEN(row, VELOCITY))) / D * bounce.xyz : vec3(0.0);
}

void main() {
    FOR_EACH_ROW(row) {
        const uint element = elementOf(row);
        if (bounces[element].w > 0.0) impulses[element] = vec4(impulseOf(owners[element], element), 0.0);
    }
}
