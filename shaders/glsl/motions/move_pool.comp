#version 460
// Moves bodies into the world and out of it. To all other passes an absent particle never moves: its inverse mass is 0,
// also in the table of masses of sleeping particles. A spawned one sleeps, and wakes at the start of the step.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/remainder.glsl"
#include "common/absent.glsl"

layout(constant_id = 1) const bool maySleep = false;
layout(constant_id = 2) const bool mayBeGrabbed = false;
layout(std430, binding = 0) readonly buffer Requests { MotionRequest requests[]; };
layout(std430, binding = 1) readonly buffer Particles { PoolParticle particles[]; };
layout(std430, binding = 2) readonly buffer Changes { uint changes[]; };
layout(std430, binding = 3) buffer Positions { vec4 positions[]; };   // x + thetaHPrevious v [m]
layout(std430, binding = 4) buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std430, binding = 5) buffer Weights { float weights[]; };      // inverse mass, also of sleeping particles [1/kg]
layout(std430, binding = 6) buffer Islands { uint islands[]; };
layout(std430, binding = 7) buffer Marks { uint marks[]; };
layout(std430, binding = 8) buffer State { SleepState state; };
layout(std430, binding = 9) buffer Grips { Grip grips[]; }; // by particle
layout(std140, binding = 10) uniform Step { StepParams step; };
layout(std430, binding = 11) buffer Groups { uint groups[]; }; // by work group: as in count_awake
layout(push_constant) uniform Push { PoolPush push; };

vec3 rotated(vec4 q, vec3 v) {
    const vec3 t = 2.0 * cross(q.xyz, v);
    return v + q.w * t + cross(q.xyz, t);
}

// Exact for a motion that does not turn.
vec3 placeOf(PoolParticle one, MotionRequest request) {
    const vec3 arm = one.rest.xyz - request.center.xyz;
    return one.rest.xyz + (request.linear.xyz + (rotated(request.rotation, arm) - arm));
}

void place(uint i, vec3 x, float time, vec3 v, float w) {
    const Sum y = exactSum(x, step.thetaHPrevious * v);
    positions[i] = vec4(y.rounded, time);
    if (hasRemainders) positions[remainderOf(positions.length(), i)].xyz = y.remainder;
    velocities[i] = vec4(v, w);
}

void wake(uint island) {
    atomicOr(marks[island], 1u);
    atomicOr(state.touched, 1u);
}

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const PoolParticle one = particles[item];
    const uint change = changes[one.body], i = one.slot;
    if (change == POOL_SAME) return;
    if (maySleep && (change >= POOL_SPAWNED || change == POOL_GONE) && weights[i] > 0.0) {
        wake(islands[i]); // what lay on it
        atomicOr(groups[i / GROUP_SIZE], 7u); // its new place reaches all buffers, also from here
    }
    if (change >= POOL_SPAWNED) {
        const MotionRequest request = requests[change - POOL_SPAWNED];
        const vec3 late = -0.5 * step.hPrevious * step.gravity.xyz; // velocities are half a substep behind positions
        place(i, placeOf(one, request), one.time, late, maySleep ? 0.0 : one.rest.w);
        if (maySleep) {
            islands[i] = request.origin;
            atomicMax(state.sleeping, 1u);
            wake(request.origin);
        }
    }
    if (change == POOL_GONE) {
        place(i, vec3(ABSENT_PLACE), one.time, vec3(0.0), 0.0);
        if (mayBeGrabbed) grips[one.particle].held &= ~((1u << GRAB_SHARE_BITS) - 1u);
    }
    if (maySleep) weights[i] = change == POOL_GONE || change == POOL_LEFT ? 0.0 : one.rest.w;
}
