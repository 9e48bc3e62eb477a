#version 460
// Every small face looks for points near it, in the cells around it and among those that stand apart, and lists them; at a
// point the face is listed too. In any order: sort_faces and link_faces sort. A face with too much around it is left to
// find_wide_faces.
#extension GL_GOOGLE_include_directive : require
#define WEIGHT_BINDING 17
#include "face_search.glsl"
#include "hash_grid.glsl"

layout(std430, binding = 10) readonly buffer Sorted { uvec4 sorted[]; };
layout(std430, binding = 11) readonly buffer Starts { uint starts[]; };
layout(std140, binding = 12) uniform Bounds { GridBounds bounds; };
layout(std430, binding = 13) buffer Points { FacePoints points; };
layout(std430, binding = 14) readonly buffer Apart { uint apart[]; };
layout(std430, binding = 15) readonly buffer SearchedFaces { uint searchedFaces[]; }; // ~0 in padding

layout(std430, binding = 16) writeonly buffer Wide { uint wide[]; };

float wayOf(uint i) { return step.h * length(velocities[i].xyz); }

void consider(Searched face, uint i, vec3 x, bool isApart, inout uint n) {
    const float size = radii[i] + wayOf(i), reach = face.reach + size;
    if (!isInBox(face, x, reach) || (size <= push.most) == isApart || !isNear(face, i, x, reach)) return;
    listAtPoint(i, face.index);
    if (face.index >= push.moving) return;
    if (n < push.capacity) faceCandidates[n * push.faceRow + face.index] = i;
    ++n;
}

// Three cells in a row from `cell` on, but none beyond `last` in x.
void searchCells(Searched face, ivec3 cell, int last, Frame frame, uint total, inout uint n) {
    const uint slot = slotOf(cell, frame), width = uint(min(last - cell.x + 1, 3)), end = starts[slot + width];
    for (uint k = starts[slot]; k < end && n <= push.limit; ++k) {
        const uvec4 point = sorted[k < total ? k : k - total];
        const vec3 x = uintBitsToFloat(point.xyz);
        const ivec3 home = cellOf(x, frame);
        if (home.yz == cell.yz && uint(home.x - cell.x) < width) consider(face, point.w, x, false, n);
    }
}

#include "face_cells.glsl"

void searchGrid(Searched face, Cells cells, Frame frame, uint total, inout uint n) {
    for (int z = cells.first.z; z <= cells.last.z; ++z)
        for (int y = cells.first.y; y <= cells.last.y; ++y)
            for (int x = cells.first.x; x <= cells.last.x; x += 3)
                searchCells(face, ivec3(x, y, z), cells.last.x, frame, total, n);
}

void searchApart(Searched face, inout uint n) {
    for (uint k = 0u; k < points.apart && n <= push.limit; ++k) consider(face, apart[k], positions[apart[k]].xyz, true, n);
}

void main() {
    const uint f = searchedFaces[itemIndex(push.searched)];
    if (f == ~0u) return;
    const Searched face = searchedOf(f);
    const uint total = starts[push.cells];
    const Frame frame = frameOf(bounds, push.cells, push.edge);
    Cells cells = Cells(ivec3(0), ivec3(-1), 0u);
    if (total > 0u) cells = cellsAround(face, frame);
    if (max(cells.points, points.apart) > FACE_MOST_POINTS) {
        wide[atomicAdd(points.wide, 1u)] = f;
        return;
    }
    uint n = 0u;
    searchGrid(face, cells, frame, total, n);
    searchApart(face, n);
    if (f < push.moving) faceFound[f] = n;
}
