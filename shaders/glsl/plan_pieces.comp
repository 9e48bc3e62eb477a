#version 460
// Says whether pieces are to be found anew: only where links were cut, and then until the labels at both ends of every link agree.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) buffer Work { CutWork work; };
layout(std430, binding = 1) buffer Counts { CutCounts counts; };
layout(std430, binding = 2) readonly buffer Groups { uint groups[]; }; // of every argument
layout(std430, binding = 3) writeonly buffer Arguments { DispatchArguments arguments[]; };
layout(std430, binding = 4) readonly buffer Listed { uint listedCounts[]; }; // by run: slots near what was cut
layout(push_constant) uniform Push { PiecesPush push; };

void main() {
    if (gl_GlobalInvocationID.x > 0u) return;
    const bool isFirst = push.isFirst != 0u;
    const uint whole = isFirst ? min(work.cut, 1u) : work.changed;
    for (uint r = 0u; r < push.runs; ++r) {
        arguments[r] = DispatchArguments(whole * groups[r], 1u, 1u, 0u);
        if (!isFirst) continue;
        arguments[push.runs + r] = DispatchArguments(whole * groups[push.runs + r], 1u, 1u, 0u);
        arguments[2u * push.runs + r] = DispatchArguments(whole * groups[r], 1u, 1u, 0u);
        arguments[3u * push.runs + r] = DispatchArguments(whole * ((listedCounts[r] + GROUP_SIZE - 1u) / GROUP_SIZE), 1u, 1u, 0u);
    }
    work.changed = 0u;
    if (!isFirst) return;
    counts.linksOfStep = work.cut;
    counts.links += work.cut;
    if (work.cut > 0u) counts.pieces = counts.crumbs = counts.crumbParticles = counts.crumbMass = 0u;
}
