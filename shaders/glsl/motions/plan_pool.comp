#version 460
// Finds out what a step does to each body that may be absent, by its motions, and by the place of its particles: that is
// the state, which undone steps restore, and from which tables of masses and radii follow. One group.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/absent.glsl"

layout(std430, binding = 0) readonly buffer Requests { MotionRequest requests[]; };
layout(std430, binding = 1) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 2) readonly buffer Pool { PoolBody pool[]; };
layout(std430, binding = 3) buffer Absent { uint absent[]; }; // by body of the pool: steps that it began absent, up to POOL_SKIPPED
layout(std430, binding = 4) writeonly buffer Changes { uint changes[]; }; // by body of the scene: POOL_...
layout(std430, binding = 5) writeonly buffer Arguments { DispatchArguments arguments[]; };
layout(push_constant) uniform Push { PoolPush push; };

shared uint changed, listed;

// The change by the last motion that places the body.
uint requestedFor(uint body) {
    uint change = POOL_SAME;
    for (uint m = 0u; m < push.motions; ++m) {
        if (requests[m].body != body || requests[m].kind < MOTION_POSE) continue;
        change = requests[m].kind == MOTION_SPAWN ? POOL_SPAWNED + m : requests[m].kind == MOTION_DESPAWN ? POOL_GONE : POOL_SAME;
    }
    return change;
}

void plan(uint b) {
    const bool isGone = isAbsent(positions[pool[b].origin].xyz);
    const uint before = absent[b];
    uint change = requestedFor(pool[b].body);
    if (change == POOL_GONE && isGone) change = POOL_SAME;
    if (change == POOL_SAME && isGone != (before != 0u)) change = isGone ? POOL_LEFT : POOL_RETURNED;
    changes[pool[b].body] = change;
    uint now = change == POOL_GONE || change == POOL_LEFT ? 1u : 0u;
    if (change != POOL_SAME) atomicOr(changed, 1u);
    else if (before != 0u) now = min(before + 1u, uint(POOL_SKIPPED));
    if ((now == POOL_SKIPPED) != (before == POOL_SKIPPED)) atomicOr(listed, 1u);
    absent[b] = now;
}

DispatchArguments argumentsFor(uint items) { return DispatchArguments((items + GROUP_SIZE - 1u) / GROUP_SIZE, 1u, 1u, 0u); }

void main() {
    const uint lane = gl_LocalInvocationID.x;
    if (lane == 0u) changed = listed = 0u;
    barrier();
    for (uint b = lane; b < push.bodies; b += GROUP_SIZE) plan(b);
    barrier();
    if (lane > 0u) return;
    arguments[POOL_PARTICLES] = argumentsFor(changed * push.count);
    arguments[POOL_EDGES] = argumentsFor(changed * POOL_EDGE_GROUPS * GROUP_SIZE);
    arguments[POOL_SLOTS] = argumentsFor(listed * push.slots);
    arguments[POOL_LISTS] = argumentsFor(listed);
    arguments[POOL_ALWAYS] = argumentsFor(1u);
}
