#version 460
// Inside test of 32 samples at a time, from the votes of the three axes. A line that enters the surface as often as
// it leaves it counts windings, so overlapping parts are inside; one with an even number of crossings counts parity,
// so flipped triangles do no harm; any other line has met a hole and has no vote. Unless all three votes exist and
// agree the sample is doubtful. CENTERS: an item is 32 cells. Else it is half of the 64 samples of a hull cell.
#extension GL_GOOGLE_include_directive : require
#include "mesh/voxel.glsl"

layout(std430, binding = 0) readonly buffer Cells { VoxelCell cells[]; };
layout(std430, binding = 1) readonly buffer HullCells { uint hullCells[]; };
layout(std430, binding = 2) readonly buffer Votes { uint votes[]; };
layout(std430, binding = 3) readonly buffer Totals { uint totals[]; };
layout(std430, binding = 4) writeonly buffer Inside { uint insideWords[]; };
layout(std430, binding = 5) writeonly buffer Doubtful { uint doubtfulWords[]; };
layout(std430, binding = 6) buffer Count { uint doubtfulCount; };

#ifdef CENTERS
const uint samples = 1u;
#else
const uint samples = 4u;
#endif
const uint lines = samples * samples;
const uint outside = 0u, inside = 1u, invalid = 2u;

uint voteOf(uint axis, uvec3 cell, uint slot, uvec3 place) {
    const uvec3 size = seenAlong(axis, uvec3(gridSize())), at = seenAlong(axis, cell), within = seenAlong(axis, place);
    const uint line = within.x + samples * within.y;
    const uint total = totals[(firstColumn(axis) + at.x + size.x * at.y) * lines + line];
    const uint bits = votes[samples == 1u ? slot : slot * lines + line] >> (2u * samples * axis);
    return total == 2u ? invalid : bits >> (total == 0u ? within.z : samples + within.z) & 1u;
}

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const uint word = push.first + i;
    uint insideBits = 0u, doubtfulBits = 0u;
    for (uint bit = 0u; bit < 32u; ++bit) {
#ifdef CENTERS
        const uint slot = word * 32u + bit;
        if (slot >= push.cellCount) break;
        if ((slot == 0u ? 0u : cells[slot - 1u].end) != cells[slot].end) continue; // hull
        const uvec3 cell = cellAt(slot), place = uvec3(0u);
#else
        const uint slot = word / 2u, sample_ = word % 2u * 32u + bit;
        const uvec3 cell = cellAt(hullCells[slot]), place = uvec3(sample_, sample_ / 4u, sample_ / 16u) % 4u;
#endif
        const uint x = voteOf(0u, cell, slot, place), y = voteOf(1u, cell, slot, place), z = voteOf(2u, cell, slot, place);
        insideBits |= uint(x == inside && y == inside && z == inside) << bit;
        doubtfulBits |= uint(x == invalid || x != y || y != z) << bit;
    }
    insideWords[word] = insideBits;
    doubtfulWords[word] = doubtfulBits;
    if (doubtfulBits != 0u) atomicAdd(doubtfulCount, uint(bitCount(doubtfulBits)));
}
