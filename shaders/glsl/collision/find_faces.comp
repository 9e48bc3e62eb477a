#version 460
// Every two small faces that share an edge search for points near them, in the cells around both and among the points
// outside of the grid, and list the pairs in any order: sort_lists and index_rows_by_owner sort. Most of the time goes
// into visits of points that are near neither. Faces with too many points around them are left to find_wide_faces. Faces
// of a patch of a sheet search only if search_patches says so.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define WEIGHT_BINDING 15
#define LINKS_BINDING 16
#define HEADINGS_BINDING 13
#include "collision/face_search.glsl"
#include "collision/hash_grid.glsl"

#include "common/fetched.glsl"
FETCHED_UVEC4(10, Sorted, sortedAt)
FETCHED_UINT(11, Starts, startAt)
#define SORTED(k) sortedAt(k)
#define START(slot) startAt(slot)
layout(std430, binding = 12) buffer Points { uint apart[]; }; // FACE_POINTS_...
layout(std430, binding = 14) readonly buffer SearchedFaces { uint searchedFaces[]; }; // in pairs; ~0 = none

#include "collision/motion_classes.glsl"
#include "collision/face_cells.glsl"

layout(constant_id = 3) const bool hasWide = true; // false: there are too few points for a face to leave any to find_wide_faces

// Particles have headings if some face deforms; only then are faces in pairs (face_lists.cpp).
bool arePaired(uint f, uint g) { return hasHeadings && g != f; }

float most = hasHeadings ? mostMotion() : 1e30; // of a point that is not apart [m]

// False for most points of the box that are not near.
bool mayBeNear(Searched face, uint i, vec3 x, bool isApart) {
    const float radius = RADIUS(i), motion = motionOf(i), reach = face.still + radius + LEEWAY(i) + 1.001 * mostApproach(face, i);
    return !isCorner(face, i) && isInBox(face, x, reach) && !isBeyondPlane(face, x, reach) && (radius + motion <= push.most && motion <= most) != isApart;
}

Box boxOf(Searched one, Searched other) {
    return Box(min(one.low, other.low), max(one.high, other.high), max(one.reach, other.reach));
}

bool isSought(uint i) { return true; }
#include "collision/near_points.glsl"

// Lists those of the found points with a bit in `near` that are near the face.
void listNear(Searched face, uint near) {
    for (; near != 0u; near &= near - 1u) {
        const uint i = foundAt(uint(findLSB(near)));
        if (isNear(face, i, POSITION(i).xyz, 0.0)) listUnlessExcluded(face, i);
    }
}

void listFound(Searched one, Searched other, uint count) {
    const bool hasOther = arePaired(one.index, other.index);
    uint nearOne = 0u, nearOther = 0u;
    for (uint k = 0u; k < count; ++k) {
        const uint i = foundAt(k);
        const vec3 x = POSITION(i).xyz;
        nearOne |= uint(mayBeNear(one, i, x, false)) << k;
        nearOther |= uint(hasOther && mayBeNear(other, i, x, false)) << k;
    }
    listNear(one, nearOne);
    listNear(other, nearOther);
}

void searchGrid(Searched one, Searched other, Box box, Cells cells, Frame frame, uint total) {
    Search search = Search(0u, 0u, 0u);
    do {
        findInGrid(box, cells, frame, total, search);
        listFound(one, other, search.found);
    } while (search.done < search.all && !isFull());
}

void searchApart(Searched face) {
    for (uint k = 0u; k < apart[FACE_POINTS_APART] && !isFull(); ++k) {
        const uint i = apart[FACE_POINTS_FIRST + k];
        const vec3 x = POSITION(i).xyz;
        if (mayBeNear(face, i, x, true) && isNear(face, i, x, 0.0)) listUnlessExcluded(face, i);
    }
}

void leaveToWide(uint f) { apart[FACE_POINTS_FIRST + push.points + push.searched + atomicAdd(apart[FACE_POINTS_WIDE], 1u)] = f; }

void main() {
    const uint all = push.loose + apart[FACE_POINTS_SEARCHING], k = itemIndex(all);
    if (k >= all) return;
    const uint item = k < push.loose ? k : apart[FACE_POINTS_FIRST + push.points + k - push.loose];
    const uint first = searchedFaces[2u * item], second = searchedFaces[2u * item + 1u];
    const uint f = first != ~0u ? first : second, g = second != ~0u ? second : first;
    if (f == ~0u) return;
    const Searched one = searchedOf(f);
    Searched other = one;
    if (arePaired(f, g)) other = searchedOf(g);
    const Box box = hasHeadings ? boxOf(one, other) : Box(one.low, one.high, one.reach);
    const uint total = START(push.cells);
    const Frame frame = frameOf(bounds, push.cells);
    Cells cells = Cells(ivec3(0), ivec3(-1), 0u);
    if (total > 0u) cells = cellsAround(box, frame);
    if (hasWide && max(cells.points, apart[FACE_POINTS_APART]) > FACE_MOST_POINTS) {
        leaveToWide(f);
        if (arePaired(f, g)) leaveToWide(g);
        return;
    }
    searchGrid(one, other, box, cells, frame, total);
    searchApart(one);
    if (arePaired(f, g)) searchApart(other);
}
