#version 460
// Finds the cells that still have all of their twelve edges: only those have a volume. Writes the fill of the cells
// around a node, with 0 for all others.
#extension GL_GOOGLE_include_directive : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer Cells { uint cells[]; };
layout(std430, binding = 2) writeonly buffer WholeCells { uint wholeCells[]; };
layout(std430, binding = 3) readonly buffer Counts { uint listedCounts[]; };
layout(std430, binding = 4) readonly buffer Listed { uint listed[]; };
#include "common/listed_slot.glsl"

bool isWhole(uint lowest) {
    for (int c = 0; c < 7; ++c) {
        const uint alive = links[uint(int(lowest) + offsetOf(cornerOf(c)))];
        for (int axis = 0; axis < 3; ++axis)
            if ((c >> axis & 1) == 0 && !isAlive(alive, axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0)) return false;
    }
    return true;
}

void main() {
    const uint i = listedSlot();
    if (i == NO_SLOT) return;
    uint around = cells[i];
    for (int k = 0; k < 8; ++k)
        if (bitfieldExtract(around, 4 * k, 4) != 0u && !isWhole(uint(int(i) + offsetOf(cornerOf(k) - 1))))
            around &= ~(0xfu << 4 * k);
    wholeCells[i] = around;
}
