#version 460
// Follows one line of sample points along an axis through the grid and stores the winding number so far at every
// sample. Lines meet triangles in the cells that list them; a crossing belongs to the cell that contains it. Nothing
// is rounded, so a closed surface gets the same answer along every axis. CENTERS: one line per column of cells, one
// sample per cell; also links the hull cells of the column. Else 16 lines per column and 4 samples per cell, from
// hull cell to hull cell.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "mesh/voxel.glsl"

layout(std430, binding = 0) readonly buffer Vertices { ivec4 vertices[]; };
layout(std430, binding = 1) readonly buffer Triangles { uvec4 triangles[]; };
layout(std430, binding = 2) readonly buffer Cells { VoxelCell cells[]; };
layout(std430, binding = 3) readonly buffer Touching { uint touching[]; };
layout(std430, binding = 4) buffer Votes { uint votes[]; };          // by cell, or by hull cell and line
layout(std430, binding = 5) writeonly buffer Totals { uint totals[]; }; // one per line: 0 closed, 1 even, 2 odd
// The first hull cell of every column along the axis, then the next one after each hull cell.
#ifdef CENTERS
layout(std430, binding = 6) writeonly buffer Links { uint links[]; };
#else
layout(std430, binding = 6) readonly buffer Links { uint links[]; };
layout(std430, binding = 7) readonly buffer HullCells { uint hullCells[]; };
#endif

#ifdef CENTERS
const uint linesPerCell = 1u, samples = 1u;
#else
const uint linesPerCell = 4u, samples = 4u;
#endif
const uint lines = linesPerCell * linesPerCell;

#include "mesh/line_crossing.glsl"

const uint none = 0xffffffffu;

uint beginOf(uint cell) {
    return cell == 0u ? 0u : cells[cell - 1u].end;
}

void note(uint slot, uint bits) {
    votes[slot] = (push.axis == 0u ? 0u : votes[slot]) | bits;
}

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const uint line = push.first + i, column = line / lines, inCell = line % lines;
    const uvec3 size = seenAlong(push.axis, uvec3(gridSize())), strides = seenAlong(push.axis, cellStrides());
    const uvec2 place = uvec2(column % size.x, column / size.x);
    const ivec2 odd = ivec2(2u * uvec2(inCell % linesPerCell, inCell / linesPerCell) + 1u);
    const ivec2 uv = ivec2(place << push.fractionBits) + odd * (cellSize() >> (samples == 1u ? 1 : 3));
    int winding = 0;
#ifdef CENTERS
    uint link = column;
    for (uint k = 0u; k < size.z; ++k) {
        const uint cell = place.x * strides.x + place.y * strides.y + k * strides.z;
        const uint begin = beginOf(cell), end = cells[cell].end;
        note(cell, passCell(begin, end, ivec3(uv, int(k << push.fractionBits)), winding));
        if (begin == end) continue;
        links[link] = cells[cell].hull;
        link = size.x * size.y + cells[cell].hull;
    }
    links[link] = none;
#else
    for (uint hull = links[column]; hull != none; hull = links[size.x * size.y + hull]) {
        const uint cell = hullCells[hull];
        const int height = int(seenAlong(push.axis, cellAt(cell)).z << push.fractionBits);
        note(hull * lines + inCell, passCell(beginOf(cell), cells[cell].end, ivec3(uv, height), winding));
    }
#endif
    totals[firstColumn(push.axis) * lines + line] = winding == 0 ? 0u : 1u + uint(winding & 1);
}
