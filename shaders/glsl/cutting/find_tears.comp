#version 460
// Tearing, second pass: lists cells that are stretched beyond the limit and more than all cells around them, in any
// order: no two of them share a link. Cells of removed fragments, which are invisible, are left
// out.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Strains { CellStrain strains[]; };
layout(std430, binding = 1) writeonly buffer Found { uint found[]; };
layout(std430, binding = 2) buffer Tears { TearCount tears; };
layout(constant_id = 1) const bool hasDebris = false;
layout(std430, binding = 3) readonly buffer Particles { uint particles[]; }; // one per slot
layout(std430, binding = 4) readonly buffer Pieces { uint pieces[]; };
bool isThere(uint cell) { return !hasDebris || pieces[particles[cell]] != REMOVED_PIECE; } // its corners are connected
layout(push_constant) uniform Push { TearPush push; };
#include "cutting/tears.glsl"

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint cell = push.first + item;
    if (!(strains[cell].strain > push.limit) || !isThere(cell)) return;
    const int rows = push.rowStride > 0u ? 1 : 0; // sheets have one
    for (int z = -1; z <= 1; ++z)
        for (int y = -rows; y <= rows; ++y)
            for (int x = -1; x <= 1; ++x) {
                const int other = int(item) + x + y * int(push.rowStride) + z * int(push.sliceStride);
                if ((x | y | z) == 0 || other < 0 || other >= int(push.count)) continue;
                if (isBefore(push.first + uint(other), cell)) return;
            }
    found[atomicAdd(tears.count, 1u)] = cell;
}
