#version 460
// Changes velocities by the motions of a step, one after another, or places bodies, before the first substep: POSE.
// A changed particle that sleeps wakes with its island. Each particle reads itself alone.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Requests { MotionRequest requests[]; };
layout(std430, binding = 1) buffer Positions { vec4 positions[]; };   // x + thetaHPrevious v [m]
layout(std430, binding = 2) buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std140, binding = 3) uniform Step { StepParams step; };
layout(std430, binding = 4) readonly buffer Frames { MotionFrame frames[]; };
layout(std430, binding = 5) readonly buffer Islands { uint islands[]; };
layout(std430, binding = 6) buffer Marks { uint marks[]; };
layout(std430, binding = 7) buffer State { SleepState state; };
layout(push_constant) uniform Push { MotionPush push; };
#define MEMBERS_BINDING 8
#include "motions/motions.glsl"
#ifdef POSE
#include "motions/pose.glsl"
layout(std430, binding = 12) readonly buffer Placed { uint placed[]; }; // by body: its pose + 1, or 0
layout(constant_id = 3) const bool isCuttable = false;
layout(std430, binding = 13) buffer PlacesBefore { vec4 placesBefore[]; }; // w = 0: a blade has not met it yet
#endif

void wake(uint i) {
    if (!maySleep || !isAsleep(weights[i], velocities[i])) return;
    atomicOr(marks[islands[i]], 1u);
    atomicOr(state.touched, 1u);
}

void write(uint i, Sum y, vec3 v) {
    positions[i].xyz = y.rounded;
    if (hasRemainders) positions[remainderOf(positions.length(), i)].xyz = y.remainder;
    velocities[i].xyz = v;
}

#ifdef POSE
void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count || bodies[i] >= push.bodies || placed[bodies[i]] == 0u || inverseMassOf(i) == 0.0) return;
    const uint k = placed[bodies[i]] - 1u;
    if (requests[k].kind != MOTION_POSE) return; // see move_pool
    wake(i);
    const vec3 v = rotated(requests[k].rotation, velocities[i].xyz);
    const Sum x = placedAt(k, placeOf(i));
    write(i, exactSum(x.rounded, x.remainder + step.thetaHPrevious * v), v);
    if (isCuttable) placesBefore[i].w = 0.0;
}
#else
void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count || inverseMassOf(i) == 0.0) return;
    const vec3 x = placeOf(i), before = velocities[i].xyz;
    vec3 v = before;
    bool isChanged = false;
    for (uint k = 0u; k < push.motions; ++k) {
        const MotionRequest request = requests[k];
        if (!isOfRound(request, 0u) || !actsOn(request, bodies[i], x)) continue;
        const MotionFrame frame = frames[k];
        const vec3 given = frame.linear.xyz + cross3(frame.angular.xyz, x - frame.origin.xyz - frame.center.xyz);
        // gravity adds the half kick at the start of the substep
        const vec3 late = push.halfKick != 0u ? 0.5 * step.hPrevious * step.gravity.xyz : vec3(0.0);
        v = request.kind == MOTION_SET_VELOCITY ? given - late : v + given;
        isChanged = true;
    }
    if (!isChanged) return;
    wake(i);
    vec3 way = step.thetaHPrevious * (v - before);
    if (hasRemainders) way += positions[remainderOf(positions.length(), i)].xyz;
    write(i, exactSum(positions[i].xyz, way), v);
}
#endif
