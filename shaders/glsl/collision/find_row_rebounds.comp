#version 460
// Restitution of contacts with faces and between edges, first pass: finds the contacts that rebound, and the speed at
// which their two sides must separate, by Newton's law against the velocities before the substep. Impacts slower than
// step.restSpeed do not rebound, or resting contacts would tremble. sum_row_weights then sums the contact weights of
// particles in these contacts alone, and solve_row_rebounds computes the impulses.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Before { vec4 before[]; };     // velocities when the substep began [m/s]
layout(std430, binding = 2) readonly buffer Contacts { uvec2 contacts[]; };
layout(std430, binding = 3) readonly buffer Owners { uint owners[]; };      // one per element
layout(std430, binding = 4) readonly buffer Directions { vec4 directions[]; };
layout(std430, binding = 5) readonly buffer Weights { vec4 weights[]; };
layout(std430, binding = 6) readonly buffer Surfaces { uint surfaces[]; }; // one per particle
layout(std430, binding = 7) readonly buffer Pairs { SurfacePair pairs[]; };
layout(std140, binding = 8) uniform Step { StepParams step; };
layout(std430, binding = 9) writeonly buffer Impulses { vec4 impulses[]; }; // w: speed [m/s]; 0 = does not rebound
layout(std430, binding = 10) readonly buffer Touched { uint touched[]; };
#define BEFORE(i) before[i]
#define WEIGHT(k) weights[k]
#include "collision/touched.h"
#include "collision/touched.glsl"
layout(push_constant) uniform Push { FacePush push; };
#define SHAPES_BINDING 1
#include "collision/row.glsl"

float speedOf(uint owner, uint element) {
    const Row row = rowOf(owner, contacts[element].x, weights[element]);
    const float speed = dot(directions[element].xyz, BETWEEN(row, BEFORE));
    return speed < -step.restSpeed ? -SURFACES(row).restitution * speed : 0.0;
}

void main() {
    FOR_EACH_TOUCHED_ROW(row) {
        const uint element = touchedRow(row);
        if (directions[element].w > 0.0) impulses[element] = vec4(vec3(0.0), speedOf(owners[element], element));
    }
}
