#version 460
// Pieces of the skin of a sheet, second pass: prefix sum over triangles, so that the order of pieces does not depend
// on timing; the draw arguments; and the missing capacity: if the pieces do not fit, none is drawn, and the host is
// told. One group.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) buffer Counts { SheetCounts counts[]; };
layout(std430, binding = 1) buffer State { SheetState state; };
layout(std430, binding = 2) writeonly buffer Draws { DrawArguments draws[]; };          // by skin
layout(std430, binding = 3) writeonly buffer Arguments { DispatchArguments arguments[]; }; // by skin: triangles, vertices
layout(std430, binding = 4) buffer CutCountsOfAll { CutCounts cut; };
layout(push_constant) uniform Push { SheetPush push; };

shared uvec2 ofLane[GROUP_SIZE];

uint groupsOf(uint items) { return (items + GROUP_SIZE - 1u) / GROUP_SIZE; }

void main() {
    const uint lane = gl_LocalInvocationID.x, run = (push.triangles - 1u) / GROUP_SIZE + 1u;
    const uint first = min(lane * run, push.triangles), end = min(first + run, push.triangles);
    uvec2 sum = uvec2(0u);
    for (uint t = first; t < end; ++t) sum += uvec2(counts[t].triangles, counts[t].vertices);
    ofLane[lane] = sum;
    barrier();
    uvec2 start = uvec2(0u), total = uvec2(0u);
    for (uint l = 0u; l < GROUP_SIZE; ++l) {
        if (l == lane) start = total;
        total += ofLane[l];
    }
    for (uint t = first; t < end; ++t) {
        const SheetCounts own = counts[t];
        counts[t] = SheetCounts(start.x, start.y);
        start += uvec2(own.triangles, own.vertices);
    }
    if (lane > 0u) return;
    const bool fits = total.x <= push.room && total.y <= push.vertexRoom;
    const uint missing = fits ? 0u : max(total.x, total.y);
    if (!fits) total = uvec2(0u);
    const bool isWritten = cut.isWritten > 0u || state.missing > 0u; // pieces that did not fit before may fit now
    state = SheetState(total.x, total.y, missing);
    cut.missing = max(push.isFirst != 0u ? 0u : cut.missing, missing);
    draws[push.skin] = DrawArguments(3u * total.x, 1u, push.firstPiece, 0, 0u);
    arguments[2u * push.skin] = DispatchArguments(isWritten ? groupsOf(push.triangles) : 0u, 1u, 1u, 0u);
    arguments[2u * push.skin + 1u] = DispatchArguments(groupsOf(total.y), 1u, 1u, 0u);
}
