#version 460
// Writes the group counts of the passes that find pieces, which run only if links were cut or restored. The first round always
// runs then, each later one if the round before requests it (union_pieces).
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Work { CutWork work; };
layout(std430, binding = 1) buffer Counts { CutCounts counts; };
layout(std430, binding = 2) readonly buffer Groups { uint groups[]; }; // one per argument
layout(std430, binding = 3) writeonly buffer Arguments { DispatchArguments arguments[]; };
layout(std430, binding = 4) readonly buffer Listed { uint listedCounts[]; }; // by run: slots near dead links
layout(std430, binding = 5) writeonly buffer Even { DispatchArguments even[]; }; // rounds 0, 2, 4 ..., by run
layout(std430, binding = 6) writeonly buffer Odd { DispatchArguments odd[]; };
layout(push_constant) uniform Push { PiecesPush push; };

DispatchArguments ofGroups(uint count) { return DispatchArguments(count, 1u, 1u, 0u); }

void main() {
    const uint count = push.rounds * push.runs, i = itemIndex(count);
    if (i >= count) return;
    const uint whole = min(work.cut | work.isChanged, 1u), r = i % push.runs, round = i / push.runs;
    const uint at = round / 2u * push.runs + r;
    const DispatchArguments ofRound = ofGroups(round == 0u ? whole * groups[r] : 0u);
    if ((round & 1u) == 0u) even[at] = ofRound;
    else odd[at] = ofRound;
    if (round > 0u) return;
    arguments[r] = ofGroups(whole * groups[r]);
    arguments[push.runs + r] = ofGroups(whole * groups[push.runs + r]);
    arguments[2u * push.runs + r] = ofGroups(whole * groups[r]);
    arguments[3u * push.runs + r] = ofGroups(whole * ((listedCounts[r] + GROUP_SIZE - 1u) / GROUP_SIZE));
    if (i > 0u) return;
    counts.linksOfStep = work.cut;
    counts.links += work.cut - work.restored;
    counts.isWritten = whole;
    if (whole > 0u) counts.pieces = counts.debris = counts.debrisParticles = counts.debrisMass = 0u;
}
