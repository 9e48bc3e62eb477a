#version 460
// Ends a substep of `split` for all particles as if there were no contacts, and checks list validity as check_pair_lists
// does. Groups with candidates are then solved by count_contacts and gather_contacts, which end the substep for them
// again.
#extension GL_GOOGLE_include_directive : require
#define VISITS_SLOTS
#include "common/kernel.glsl"
#include "collision/hash_grid.glsl"
#include "common/remainder.glsl"

#include "common/fetched.glsl"
FETCHED_VEC4(0, Positions, positionAt)
FETCHED_VEC4(1, Detected, detectedAt)   // positions when lists were made; w: body
FETCHED_VEC4(2, Velocities, velocityAt) // that led to these positions [m/s]; w = inverse mass
#define POSITION(i) positionAt(i)
#define DETECTED(i) detectedAt(i)
#define VELOCITY(i) velocityAt(i)
layout(std430, binding = 3) buffer Bounds { GridBounds bounds; };
layout(std430, binding = 4) readonly buffer Radii { float radii[]; };
layout(std430, binding = 5) writeonly buffer Fast { uint fast[]; };
layout(std140, binding = 6) uniform Step { StepParams step; };
#define FRAMES_BINDING 7
#define WAYS_BINDING 14
#define HEADING(i) vec4(0.0)
layout(std430, binding = 8) readonly buffer Predicted { vec4 predicted[]; };
layout(std430, binding = 9) writeonly buffer NextPositions { vec4 nextPositions[]; };
layout(std430, binding = 10) writeonly buffer NextVelocities { vec4 nextVelocities[]; };
layout(std430, binding = 11) readonly buffer Before { vec4 before[]; }; // velocities before the substep, where planes have restitution
#define BEFORE(i) before[i].xyz
#define PLANE_BINDING 12
layout(constant_id = 13) const bool hasRebound = false;
#define HAS_REBOUND hasRebound
#define NO_FORCES
#include "forces/forces.glsl"
#include "collision/finish_substep.glsl"
layout(push_constant) uniform Push { GridPush push; };
#include "collision/list_check.glsl"
layout(constant_id = 3) const bool checksLists = true; // false: only particles that were slowed down since

void main() {
    const uint i = itemIndex(push.count);
    if (i == ~0u) return;
    const vec4 x = POSITION(i), velocity = VELOCITY(i);
    finish(i, x.xyz, x.w, velocity, vec3(0.0), velocity.xyz + vec3(0.0));
    if (checksLists) checkLists(i, x.xyz, velocity.xyz);
}
