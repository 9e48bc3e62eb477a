#version 460
// Every small face searches for points near it, in the cells around it and among the points outside of the grid, and
// lists the pairs in any order: sort_lists and index_rows_by_owner sort. A face with too many points around it is left to
// find_wide_faces.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define WEIGHT_BINDING 15
#define LINKS_BINDING 16
#include "collision/face_search.glsl"
#include "collision/hash_grid.glsl"

#include "common/fetched.glsl"
FETCHED_UVEC4(10, Sorted, sortedAt)
FETCHED_UINT(11, Starts, startAt)
#define SORTED(k) sortedAt(k)
#define START(slot) startAt(slot)
layout(std430, binding = 12) buffer Points { FacePoints points; };
layout(std430, binding = 13) buffer Apart { uint apart[]; }; // points; from push.points on, wide faces
layout(std430, binding = 14) readonly buffer SearchedFaces { uint searchedFaces[]; }; // ~0 in padding

#include "collision/face_cells.glsl"
#include "collision/grid_rows.glsl"

bool isNearby(Searched face, uint i, vec3 x, bool isApart) {
    const float size = sizeOf(RADIUS(i), step.h, VELOCITY(i).xyz), reach = face.reach + size;
    return isInBox(face, x, reach) && (size <= push.most) != isApart && isNear(face, i, x, 0.0);
}

// The points near the box of the face in up to 32 visits from `from` on: bit v for visit from + v.
uint around(Searched face, float range, Rows rows, uint from, uint total) {
    const uint last = min(from + 32u, rows.all);
    uint visits = 0u;
    for (uint visit = from; visit < last; ++visit) {
        const vec3 x = uintBitsToFloat(SORTED(placeOf(rows, visit, total)).xyz);
        visits |= uint(isInBox(face, x, range)) << visit - from;
    }
    return visits;
}

// The points near the face, among these visits.
uint nearOf(Searched face, uint visits, Rows rows, uint from, Frame frame, uint total) {
    uint near = 0u;
    for (; visits != 0u; visits &= visits - 1u) {
        const int bit = findLSB(visits);
        const uint visit = from + uint(bit);
        const uvec4 point = SORTED(placeOf(rows, visit, total));
        const vec3 x = uintBitsToFloat(point.xyz);
        if (isIn(rows, visit, cellOf(x, frame)) && isNearby(face, point.w, x, false)) near |= 1u << bit;
    }
    return near;
}

// Branches are what costs: a batch is measured first, and only the remaining points are processed then.
void searchRows(Searched face, float range, Rows rows, Frame frame, uint total) {
    for (uint from = 0u; from < rows.all && !isFull(); from += 32u) {
        uint near = nearOf(face, around(face, range, rows, from, total), rows, from, frame, total);
        for (; near != 0u; near &= near - 1u)
            listUnlessExcluded(face, SORTED(placeOf(rows, from + uint(findLSB(near)), total)).w);
    }
}

void searchGrid(Searched face, Cells cells, Frame frame, uint total) {
    const float range = rangeOf(face);
    for (int z = cells.first.z; z <= cells.last.z; ++z)
        for (int y = cells.first.y; y <= cells.last.y; y += 3)
            for (int x = cells.first.x; x <= cells.last.x; x += 3)
                searchRows(face, range, rowsFrom(ivec3(x, y, z), cells.last, frame), frame, total);
}

void searchApart(Searched face) {
    for (uint k = 0u; k < points.apart && !isFull(); ++k)
        if (isNearby(face, apart[k], POSITION(apart[k]).xyz, true)) listUnlessExcluded(face, apart[k]);
}

void main() {
    const uint f = searchedFaces[itemIndex(push.searched)];
    if (f == ~0u) return;
    const Searched face = searchedOf(f);
    const uint total = START(push.cells);
    const Frame frame = frameOf(bounds, push.cells);
    Cells cells = Cells(ivec3(0), ivec3(-1), 0u);
    if (total > 0u) cells = cellsAround(face, frame);
    if (max(cells.points, points.apart) > FACE_MOST_POINTS) {
        apart[push.points + atomicAdd(points.wide, 1u)] = f;
        return;
    }
    searchGrid(face, cells, frame, total);
    searchApart(face);
}
