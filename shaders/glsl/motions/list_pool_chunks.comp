#version 460
// Lists the chunks of a lattice dispatch whose bodies are in the world, in order, and writes its group count, twice: the
// second stays where the first depends on what sleeps (gate_pool_chunks). One group, whose lanes process a run of the list
// each.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer All { LatticeChunk all[]; };
layout(std430, binding = 1) readonly buffer Bodies { uint bodies[]; }; // by chunk: body of the pool, or POOL_STAYS
layout(std430, binding = 2) readonly buffer Absent { uint absent[]; }; // by body of the pool: as in plan_pool
layout(std430, binding = 3) writeonly buffer Chunks { LatticeChunk chunks[]; };
layout(std430, binding = 4) writeonly buffer Arguments { DispatchArguments arguments[]; };
layout(push_constant) uniform Push { PoolListPush push; };

shared uint sums[GROUP_SIZE];

bool isListed(uint c) {
    return all[c].layers > 0u && (bodies[c] == POOL_STAYS || absent[bodies[c]] != POOL_SKIPPED);
}

void main() {
    const uint lane = gl_LocalInvocationID.x, run = (push.count - 1u) / GROUP_SIZE + 1u;
    const uint first = min(lane * run, push.count), end = min(first + run, push.count);
    uint own = 0u;
    for (uint c = first; c < end; ++c) own += isListed(c) ? 1u : 0u;
    sums[lane] = own;
    barrier();
    uint place = 0u, total = 0u;
    for (uint l = 0u; l < GROUP_SIZE; ++l) {
        if (l == lane) place = total;
        total += sums[l];
    }
    const uint firstListed = isReversed ? push.end - total : 0u;
    for (uint c = first; c < end; ++c)
        if (isListed(c)) chunks[firstListed + place++] = all[c];
    for (uint c = lane; c < push.count; c += GROUP_SIZE)
        if (c < firstListed || c >= firstListed + total) chunks[c] = LatticeChunk(all[0].origin, 0u);
    if (lane == 0u) arguments[0] = arguments[1] = DispatchArguments((total + push.perGroup - 1u) / push.perGroup, 1u, 1u, 0u);
}
