#version 460
// The hull: finds every cell that a triangle touches, by the separating axis test of Schwarz and Seidel (2010),
// section 3. An item is one row of cells, along x, in the bounding box of one triangle, so that a large triangle is
// many items. First the triangles of every cell are counted, then (LISTS) they are listed; their order in a list
// varies and changes nothing.
#extension GL_GOOGLE_include_directive : require
#include "mesh/voxel.glsl"

layout(std430, binding = 0) readonly buffer Vertices { ivec4 vertices[]; };
layout(std430, binding = 1) readonly buffer Triangles { uvec4 triangles[]; };
layout(std430, binding = 2) readonly buffer RowStarts { uint rowStarts[]; }; // one per triangle, counted within its batch
layout(std430, binding = 3) buffer Cells { VoxelCell cells[]; };
#ifdef LISTS
layout(std430, binding = 4) writeonly buffer Touching { uint touching[]; };
#endif

void mark(uint cell, uint triangle) {
#ifdef LISTS
    touching[atomicAdd(cells[cell].end, 1u)] = triangle;
#else
    if (atomicAdd(cells[cell].end, 1u) == 0u) cells[cell].hull = 1u;
#endif
}

// The last triangle of the batch that starts at or before `row`.
uint triangleOf(uint row) {
    uint low = push.triangle, high = push.triangle + push.triangleCount;
    while (high - low > 1u) {
        const uint middle = (low + high) / 2u;
        if (rowStarts[middle] <= row)
            low = middle;
        else
            high = middle;
    }
    return low;
}

#include "mesh/square_edges.glsl"

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const uint triangle = triangleOf(push.first + i);
    const uvec4 corners = triangles[triangle];
    const ivec3 a = vertices[corners.x].xyz, b = vertices[corners.y].xyz, c = vertices[corners.z].xyz;
    // Cells count as closed and a unit larger all around: a vertex was rounded by half a unit.
    const int bits = int(push.fractionBits), size = cellSize() + 2;
    const ivec3 low = max((min(min(a, b), c) - 1) >> bits, ivec3(0));
    const ivec3 high = min((max(max(a, b), c) + 1) >> bits, gridSize() - 1);
    const int row = int(push.first + i - rowStarts[triangle]), rows = high.y - low.y + 1;
    const ivec3 first = ivec3(low.x, low.y + row % rows, low.z + row / rows);
    ivec3 corner = (first << bits) - 1;

    const ivec3 ab = b - a, ac = c - a;
    const Int64 nx = cross(ab.yz, ac.yz), ny = cross(ab.zx, ac.zx), nz = cross(ab.xy, ac.xy);
    const Int96 sx = multiply(nx, size), sy = multiply(ny, size), sz = multiply(nz, size), none = Int96(0u, 0u, 0);
    Int96 plane = add(add(multiply(nx, corner.x - a.x), multiply(ny, corner.y - a.y)), multiply(nz, corner.z - a.z));
    const Int96 near = add(add(sx.high < 0 ? none : sx, sy.high < 0 ? none : sy), sz.high < 0 ? none : sz);
    const Int96 far = add(add(sx.high < 0 ? sx : none, sy.high < 0 ? sy : none), sz.high < 0 ? sz : none);
    const Int96 step = multiply(nx, cellSize());
    if (!isBesideEdges(a.yz, b.yz, c.yz, nx, corner.yz, size)) return;
    uint cell = uint(first.x) + push.cellsX * (uint(first.y) + push.cellsY * uint(first.z));
    for (int x = first.x; x <= high.x; ++x) {
        if (add(plane, near).high >= 0 && !isPositive(add(plane, far)) &&
            isBesideEdges(a.zx, b.zx, c.zx, ny, corner.zx, size) && isBesideEdges(a.xy, b.xy, c.xy, nz, corner.xy, size))
            mark(cell, triangle);
        plane = add(plane, step);
        corner.x += cellSize();
        ++cell;
    }
}
