#version 460
// Ends a substep of `split` for all particles as if there were no contacts, and checks list validity as check_pair_lists
// does. Groups with candidates are then solved by count_contacts and gather_contacts, which end the substep for them
// again.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "collision/hash_grid.glsl"
#include "common/remainder.glsl"

#ifdef TEXELS
layout(binding = 0) uniform samplerBuffer positions;
layout(binding = 1) uniform samplerBuffer detected;
layout(binding = 2) uniform samplerBuffer velocities;
#define POSITION(i) texelFetch(positions, int(i))
#define DETECTED(i) texelFetch(detected, int(i))
#define VELOCITY(i) texelFetch(velocities, int(i))
#else
layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Detected { vec4 detected[]; }; // positions when lists were made; w: body
layout(std430, binding = 2) readonly buffer Velocities { vec4 velocities[]; }; // that led to these positions; w = inverse mass
#define POSITION(i) positions[i]
#define DETECTED(i) detected[i]
#define VELOCITY(i) velocities[i]
#endif
layout(std430, binding = 3) buffer Bounds { GridBounds bounds; };
layout(std430, binding = 4) readonly buffer Radii { float radii[]; };
layout(std430, binding = 5) writeonly buffer Fast { uint fast[]; };
layout(std140, binding = 6) uniform Step { StepParams step; };
#define FRAMES_BINDING 7
#include "collision/list_check.glsl"
layout(std430, binding = 8) readonly buffer Predicted { vec4 predicted[]; };
layout(std430, binding = 9) writeonly buffer NextPositions { vec4 nextPositions[]; };
layout(std430, binding = 10) writeonly buffer NextVelocities { vec4 nextVelocities[]; };
#ifdef HAS_REBOUND
layout(std430, binding = 11) readonly buffer Before { vec4 before[]; }; // velocities before the substep
#define BEFORE(i) before[i].xyz
#define PLANE_BINDING 12
#else
#define PLANE_BINDING 11
#endif
#include "collision/finish_substep.glsl"
layout(push_constant) uniform Push { GridPush push; };
layout(constant_id = 3) const bool checksLists = true; // false: only particles that were slowed down since

void main() {
    const uint i = itemIndex(push.count);
    if (i == ~0u) return;
    const vec4 x = POSITION(i), velocity = VELOCITY(i);
    finish(i, x.xyz, x.w, velocity, vec3(0.0), velocity.xyz + vec3(0.0));
    if (checksLists) checkLists(i, x.xyz, velocity.xyz, push.quiet, push.most);
}
