#version 460
// Marks the work groups of particles that run: those with a particle whose body is in the world. The first one runs
// always, and with it passes that run whole or not at all.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Bodies { uint bodies[]; }; // by slot: body of the pool, POOL_STAYS, or POOL_PADDING
layout(std430, binding = 1) readonly buffer Absent { uint absent[]; }; // by body of the pool: as in plan_pool
layout(std430, binding = 2) writeonly buffer Groups { uint groups[]; };
layout(push_constant) uniform Push { PoolPush push; };

shared uint runs;

bool isThere(uint body) {
    return body == POOL_STAYS || body != POOL_PADDING && absent[body] != POOL_SKIPPED;
}

void main() {
    const uint i = itemIndex(push.slots);
    if (gl_LocalInvocationID.x == 0u) runs = i < GROUP_SIZE ? 1u : 0u;
    barrier();
    if (i < push.slots && isThere(bodies[i])) atomicOr(runs, 1u);
    barrier();
    if (gl_LocalInvocationID.x == 0u) groups[i / GROUP_SIZE] = runs;
}
