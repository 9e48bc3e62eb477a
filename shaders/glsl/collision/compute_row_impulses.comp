#version 460
// Contacts with faces and between edges, third pass: the impulse of each contact, along n and against the slip t of
// the pair since it first touched:
//
//   l = depth / D,   D = sum_k |beta_k| S_k w_k,   friction: t / D, at most static friction x l, else friction x l.
//
// The memory stores the actual slip at the start of the substep, less the part beyond the friction bound: the
// predicted slip is larger by what friction took back, and summing it up would make bodies creep uphill.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

#include "common/fetched.glsl"
FETCHED_VEC4(0, Velocities, velocityAt)
FETCHED_VEC4(4, Directions, directionAt) // n, depth [m]; 0 = does not touch
FETCHED_VEC4(5, Weights, weightAt)
FETCHED_VEC4(9, Before, beforeAt)        // velocities at the start of the substep
#define VELOCITY(i) velocityAt(i)
#define DIRECTION(k) directionAt(k)
#define WEIGHT(k) weightAt(k)
#define BEFORE(i) beforeAt(i)
layout(std430, binding = 2) readonly buffer Contacts { uvec2 contacts[]; }; // ContactCandidate, in one load
layout(std430, binding = 3) readonly buffer Owners { uint owners[]; };      // one per element
layout(std430, binding = 6) readonly buffer Shares { float shares[]; };
layout(std430, binding = 7) buffer Memory { vec4 memory[]; };            // slip t [m]; w: side and overlap
layout(std430, binding = 8) writeonly buffer Impulses { vec4 impulses[]; }; // [kg m]
layout(std140, binding = 10) uniform Step { StepParams step; };
layout(std430, binding = 11) readonly buffer Surfaces { uint surfaces[]; }; // one per particle
layout(std430, binding = 12) readonly buffer Pairs { SurfacePair pairs[]; };
layout(std430, binding = 13) readonly buffer Touched { uint touched[]; };
#include "collision/touched.h"
#include "collision/touched.glsl"
layout(push_constant) uniform Push { FacePush push; };
#define SHAPES_BINDING 1
#include "collision/row.glsl"

void press(uint owner, uint element) {
    const vec4 direction = DIRECTION(element), weight = WEIGHT(element);
    if (direction.w == 0.0) {
        memory[element] = vec4(vec3(0.0), weight.w); // an overlap that has yet to recover
        return;
    }
    const Row row = rowOf(owner, contacts[element].x, weight);
    const vec3 n = direction.xyz;
    const float D = SHARED(row, shares);
    const float share = D > 0.0 ? 1.0 / D : 0.0, lambda = share * abs(direction.w);
    vec3 slid = vec3(0.0); // slip until this substep
    if (memory[element].w != 0.0) slid = memory[element].xyz + step.h * BETWEEN(row, BEFORE);
    vec3 slip = slid + step.h * BETWEEN(row, VELOCITY);
    slip -= dot(slip, n) * n;
    const SurfacePair pair = SURFACES(row);
    const float force = length(slip) * share;
    const float held = force > pair.staticFriction * lambda ? pair.friction * lambda / force : 1.0;
    memory[element] = vec4(slid - (1.0 - held) * slip, weight.w);
    slip *= held;
    impulses[element] = vec4(lambda * n - share * slip, 0.0);
}

void main() {
    FOR_EACH_TOUCHED_ROW(row) {
        const uint element = touchedRow(row);
        press(owners[element], element);
    }
}
