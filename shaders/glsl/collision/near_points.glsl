// Points of the hash grid near a box, up to so many at a time. Tests of a face cost much more than visits, also where a
// branch skips them on a software device, and most visited points are near no face. Requires the names of face_cells.glsl
// and isSought(i), false for a point that is left out. Where the box is around too many cells, all points are visited.
#include "collision/grid_rows.glsl"

#define MOST_FOUND 16u
shared uint found[MOST_FOUND * GROUP_SIZE];
uint foundAt(uint k) { return found[k * GROUP_SIZE + gl_LocalInvocationIndex]; }

// A search of the cells, in turns that each end when so many points are found.
struct Search {
    uint done, all; // visits of the turns so far, of the whole search
    uint found;     // points of this turn
};

void findInRows(Box box, float range, Rows rows, Frame frame, uint total, inout Search search) {
    for (uint visit = max(search.done, search.all) - search.all; visit < rows.all && search.found < MOST_FOUND; ++visit) {
        search.done = search.all + visit + 1u;
        const uvec4 point = SORTED(placeOf(rows, visit, total));
        const vec3 x = uintBitsToFloat(point.xyz);
        if (!isInBox(box.low, box.high, x, range) || !isSought(point.w) || !isIn(rows, visit, cellOf(x, frame))) continue;
        found[search.found * GROUP_SIZE + gl_LocalInvocationIndex] = point.w;
        ++search.found;
    }
    search.all += rows.all;
}

void findInAll(Box box, float range, uint total, inout Search search) {
    for (search.all = total; search.done < total && search.found < MOST_FOUND; ++search.done) {
        const uvec4 point = SORTED(search.done);
        if (!isInBox(box.low, box.high, uintBitsToFloat(point.xyz), range) || !isSought(point.w)) continue;
        found[search.found * GROUP_SIZE + gl_LocalInvocationIndex] = point.w;
        ++search.found;
    }
}

void findInGrid(Box box, Cells cells, Frame frame, uint total, inout Search search) {
    const float range = rangeOf(box);
    search.all = search.found = 0u;
    if (cells.points == ~0u) findInAll(box, range, total, search);
    for (int z = cells.first.z; z <= cells.last.z; ++z)
        for (int y = cells.first.y; y <= cells.last.y; y += 3)
            for (int x = cells.first.x; x <= cells.last.x; x += 3)
                findInRows(box, range, rowsFrom(ivec3(x, y, z), cells.last, frame), frame, total, search);
}
