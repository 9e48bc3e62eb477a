// The block of cells around a face in which find_faces searches for points. Requires the names of that kernel.
const float mostCells = 1000.0; // around a face

#include "collision/cell_points.glsl"

struct Cells {
    ivec3 first, last;
    uint points; // number of points in them
};

// The distance from the face beyond which no point of the grid is near; slightly larger because of rounding [m].
float rangeOf(Searched face) {
    const vec3 size = max(abs(face.low), abs(face.high));
    return 1.01 * (face.reach + uintBitsToFloat(points.widest)) + 1e-6 * max(size.x, max(size.y, size.z));
}

// Empty, with points = ~0, if the block has more than mostCells cells.
Cells cellsAround(Searched face, Frame frame) {
    const float reach = rangeOf(face);
    const vec3 top = vec3(valueOf(bounds.highX), valueOf(bounds.highY), valueOf(bounds.highZ));
    const vec3 low = max(face.low - reach, frame.low), high = min(face.high + reach, top);
    Cells cells = Cells(ivec3(0), ivec3(-1), 0u);
    if (any(lessThan(high, low))) return cells;
    cells.first = cellOf(low, frame);
    cells.last = cellOf(high, frame);
    const vec3 size = vec3(cells.last - cells.first + 1);
    if (!(size.x * size.y * size.z <= mostCells)) return Cells(ivec3(0), ivec3(-1), ~0u);
    cells.points = pointsIn(cells.first, cells.last, frame);
    return cells;
}
