// The block of cells around a box of faces in which their points are searched for. Requires the names bounds, apart, push
// and START of a kernel.
const float mostCells = 1000.0; // around a box

#include "collision/cell_points.glsl"

struct Cells {
    ivec3 first, last;
    uint points; // number of points in them
};

// The box of one or two faces, or of a patch; reach as in Searched.
struct Box {
    vec3 low, high;
    float reach;
};

// The distance from the box beyond which no point of the grid is near; slightly larger because of rounding [m].
float rangeOf(Box box) {
    const vec3 size = max(abs(box.low), abs(box.high));
    return 1.01 * (box.reach + uintBitsToFloat(apart[FACE_POINTS_WIDEST])) + 1e-6 * max(size.x, max(size.y, size.z));
}

// Empty, with points = ~0, if the block has more than mostCells cells.
Cells cellsAround(Box box, Frame frame) {
    const float reach = rangeOf(box);
    const vec3 top = vec3(valueOf(bounds.highX), valueOf(bounds.highY), valueOf(bounds.highZ));
    const vec3 low = max(box.low - reach, frame.low), high = min(box.high + reach, top);
    Cells cells = Cells(ivec3(0), ivec3(-1), 0u);
    if (any(lessThan(high, low))) return cells;
    cells.first = cellOf(low, frame);
    cells.last = cellOf(high, frame);
    const vec3 size = vec3(cells.last - cells.first + 1);
    if (!(size.x * size.y * size.z <= mostCells)) return Cells(ivec3(0), ivec3(-1), ~0u);
    cells.points = pointsIn(cells.first, cells.last, frame);
    return cells;
}
