#version 460
// Marks the occupied cells of a hash grid, as built last: the first particle of a cell writes its mark, with the
// number of its particles and of those of other cells that share its slot of the table.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "collision/hash_grid.glsl"
#include "viewer/values.h"

layout(std430, binding = 0) readonly buffer Bounds { GridBounds bounds; };
layout(std430, binding = 1) readonly buffer Starts { uint starts[]; };
layout(std430, binding = 2) readonly buffer Sorted { uvec4 sorted[]; }; // bits of the position; index
layout(std430, binding = 3) writeonly buffer Marks { CellMark marks[]; };
layout(std430, binding = 4) buffer Draws { CellDraw draws[]; };
layout(push_constant) uniform Push { CellPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= starts[push.cells]) return; // number of particles in the grid
    const Frame grid = frameOf(bounds, push.cells);
    const ivec3 cell = cellOf(uintBitsToFloat(sorted[i].xyz), grid);
    const uint slot = slotOf(cell, grid);
    uint own = 0u, strange = 0u;
    for (uint j = starts[slot]; j < starts[slot + 1u]; ++j) {
        if (cellOf(uintBitsToFloat(sorted[j].xyz), grid) != cell) {
            ++strange;
            continue;
        }
        if (j < i) return;
        ++own;
    }
    const uint place = atomicAdd(draws[push.grid].instanceCount, 1u);
    atomicMax(draws[push.grid].most, own);
    atomicAdd(draws[push.grid].held, own);
    if (strange > 0u) atomicAdd(draws[push.grid].sharing, 1u);
    const float edge = 1.0 / grid.perLength;
    draws[push.grid].edge = edge;
    marks[push.first + place] = CellMark(vec4(grid.low + edge * vec3(cell), edge), vec4(own, strange, 0.0, 0.0));
}
