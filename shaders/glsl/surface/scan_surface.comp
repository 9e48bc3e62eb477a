#version 460
// Prefix sum over chunks of slots: their offsets in the lists of a cut surface, in the order of slots, so that the
// surface does not depend on timing; the draw arguments; and the missing capacity: if the surface does not fit, it is
// empty, and the host is told. One group.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) buffer Sums { uvec4 sums[]; }; // points, inner triangles, outer triangles, slots; becomes their offsets
layout(std430, binding = 1) writeonly buffer Arguments { DispatchArguments arguments[]; };
layout(std430, binding = 2) writeonly buffer Draws { DrawArguments draws[]; };
layout(std430, binding = 3) buffer State { SurfaceState state; };
layout(std430, binding = 4) readonly buffer Groups { uint groups[]; }; // one per run of slots
layout(std430, binding = 5) buffer Counts { CutCounts counts; };
layout(std430, binding = 6) writeonly buffer Listed { uint listed[]; };
layout(std430, binding = 7) readonly buffer Blade { BladeHead blade; };
layout(push_constant) uniform Push { SurfacePush push; };

shared uvec4 ofLane[GROUP_SIZE];

uint groupsOf(uint items) { return (items + GROUP_SIZE - 1u) / GROUP_SIZE; }

void main() {
    const uint lane = gl_LocalInvocationID.x, run = (push.chunks - 1u) / GROUP_SIZE + 1u;
    const uint first = min(lane * run, push.chunks), end = min(first + run, push.chunks);
    uvec4 sum = uvec4(0u);
    for (uint c = first; c < end; ++c) sum += sums[c];
    ofLane[lane] = sum;
    barrier();
    uvec4 start = uvec4(0u), total = uvec4(0u);
    for (uint l = 0u; l < GROUP_SIZE; ++l) {
        if (l == lane) start = total;
        total += ofLane[l];
    }
    for (uint c = first; c < end; ++c) {
        const uvec4 own = sums[c];
        sums[c] = start;
        start += own;
    }
    if (lane > 0u) return;
    const uint needed = max(total.y + total.z, total.x + 3u * total.z);
    const uint fits = needed <= push.room ? 1u : 0u;
    const uint isCut = min(total.x, 1u); // skins are drawn as cut even without the surface
    total *= fits;
    // a surface that did not fit before may fit now; and rims also move in steps in which no link dies
    const bool isWritten = counts.isWritten > 0u || state.missing > 0u || blade.quads > 0u;
    state = SurfaceState(total.x, total.y, total.z, fits == 0u ? needed : 0u);
    counts.missing = fits == 0u ? needed : 0u;
    draws[0] = DrawArguments(3u * total.y, 1u, 0u, 0, 0u);
    draws[1] = DrawArguments(3u * total.z, 1u, 3u * total.y, 0, 0u);
    for (uint r = 0u; r < push.runs; ++r) arguments[r] = DispatchArguments(isCut * groups[r], 1u, 1u, 0u);
    listed[0] = total.w;
    arguments[push.runs + SURFACE_LISTED] = DispatchArguments(isWritten ? groupsOf(total.w) : 0u, 1u, 1u, 0u);
    arguments[push.runs + SURFACE_HUNG] = DispatchArguments(isCut * groupsOf(push.hung), 1u, 1u, 0u);
    arguments[push.runs + SURFACE_VERTICES] = DispatchArguments(groupsOf(total.x + 3u * total.z), 1u, 1u, 0u);
    arguments[push.runs + SURFACE_POINTS] = DispatchArguments(groupsOf(total.x), 1u, 1u, 0u);
    arguments[push.runs + SURFACE_OUTSIDE] = DispatchArguments(groupsOf(3u * total.z), 1u, 1u, 0u);
}
