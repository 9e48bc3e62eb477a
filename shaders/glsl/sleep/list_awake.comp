#version 460
// Lists the work groups that run, in order, and writes the group count of every pass. One group, whose lanes process
// a run of the list each.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Groups { uint groups[]; };   // one per work group of particles; 0 = all asleep
layout(std430, binding = 1) writeonly buffer Listed { uint listed[]; };  // groups that run
layout(std430, binding = 2) readonly buffer Passes { SleepPass passes[]; };
layout(std430, binding = 3) writeonly buffer Arguments { DispatchArguments arguments[]; }; // one per pass
layout(std430, binding = 4) buffer State { SleepState state; };
layout(push_constant) uniform Push { SleepPush push; };

shared uint sums[GROUP_SIZE];
shared uint before[GROUP_SIZE];

// Number of running groups from `first` to below `end`.
uint running(uint first, uint end) {
    uint sum = 0u;
    for (uint g = first; g < end; ++g) sum += groups[g] != 0u ? 1u : 0u;
    return sum;
}

void main() {
    const uint lane = gl_LocalInvocationID.x, run = (push.groups - 1u) / GROUP_SIZE + 1u;
    const uint first = min(lane * run, push.groups), end = min(first + run, push.groups);
    sums[lane] = running(first, end);
    barrier();
    uint place = 0u;
    for (uint l = 0u; l < lane; ++l) place += sums[l];
    before[lane] = place;
    for (uint g = first; g < end; ++g)
        if (groups[g] != 0u) listed[place++] = g;
    barrier();
    const uint all = before[GROUP_SIZE - 1u] + sums[GROUP_SIZE - 1u];
    const bool isMixed = all > 0u && state.sleeping > 0u;
    for (uint p = lane; p < push.passes; p += GROUP_SIZE) {
        const SleepPass pass = passes[p];
        const uint most = min(pass.groups, push.groups), at = most / run; // the run in which the pass ends
        const uint some = at < GROUP_SIZE ? before[at] + running(at * run, most) : all;
        const bool isListed = pass.kind == SLEEP_LISTED || pass.kind == SLEEP_MIXED;
        const bool runs = all > 0u && (isMixed || pass.kind == SLEEP_ALL || pass.kind == SLEEP_LISTED);
        arguments[p] = DispatchArguments(!runs ? 0u : isListed ? some : pass.groups, 1u, 1u, 0u);
    }
    if (lane > 0u) return;
    state.listed = all;
    state.isMixed = isMixed ? 1u : 0u;
}
