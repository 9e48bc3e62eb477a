#version 460
// When lists are made, finds the patches of sheets that are alone: their shape keeps their own points from their faces
// (patch_shape.glsl), and no other point is near. Their faces need no search. Those of all others are left to find_faces.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/kernel.glsl"
#include "collision/hash_grid.glsl"

#include "common/fetched.glsl"
FETCHED_VEC4(0, Positions, positionAt)
FETCHED_VEC4(1, Velocities, velocityAt)
FETCHED_FLOAT(2, Radii, radiusOf) // below 0 = touches no face
FETCHED_VEC4(3, Headings, headingAt)
FETCHED_UVEC4(4, Sorted, sortedAt)
FETCHED_UINT(5, Starts, startAt)
#define POSITION(i) positionAt(i)
#define VELOCITY(i) velocityAt(i)
#define RADIUS(i) radiusOf(i)
#define SORTED(k) sortedAt(k)
#define START(slot) startAt(slot)
layout(std140, binding = 6) uniform Step { StepParams step; };
layout(std140, binding = 7) uniform Bounds { GridBounds bounds; };
layout(std430, binding = 8) readonly buffer Patches { SheetPatch patches[]; };
layout(std430, binding = 9) writeonly buffer Alone { uint alone[]; }; // 1 = it is
layout(std430, binding = 10) buffer Points { uint apart[]; };        // FACE_POINTS_...
layout(std430, binding = 11) buffer Making { DispatchArguments making[]; };
layout(push_constant) uniform Push { SearchPatchesPush push; };
#include "collision/in_box.glsl"
#include "collision/face_points.h"
#include "collision/face_cells.glsl"
#include "collision/motion_of.glsl"
#include "collision/patch_shape.glsl"

SheetPatch own;

// Points of the region are near by nature; its shape keeps them away.
bool isSought(uint i) {
    const uint place = i - own.first, row = place / own.stride;
    return row >= PATCH_REGION || place - row * own.stride >= PATCH_REGION;
}
#include "collision/near_points.glsl"

// The nodes of a patch: their box, in space and along axes of its own, and their motion.
struct Nodes {
    Box box;
    mat3 axes;
    vec3 low, high;         // along the axes [m]
    vec3 v, w;              // velocity and heading of one of them [m/s]
    float turning, bending; // most motion against these, in the substep and along headings [m]
    float still;            // distance at which a point is near, without its radius and all motion [m]
};

uint nodeOf(uint x, uint y) { return own.first + x + own.stride * y; }

Nodes nodesOfPatch() {
    const uint x0 = own.nodes & 255u, y0 = own.nodes >> 8 & 255u, nx = own.nodes >> 16 & 255u, ny = own.nodes >> 24;
    const vec3 corner = POSITION(nodeOf(x0, y0)).xyz;
    const vec3 along = unit(POSITION(nodeOf(x0 + nx - 1u, y0)).xyz - corner);
    const vec3 normal = unit(cross(along, POSITION(nodeOf(x0, y0 + ny - 1u)).xyz - corner));
    const uint middle = nodeOf(x0 + nx / 2u, y0 + ny / 2u);
    Nodes nodes;
    nodes.axes = transpose(mat3(along, cross(normal, along), normal));
    nodes.v = VELOCITY(middle).xyz;
    nodes.w = headingAt(middle).xyz;
    nodes.low = nodes.box.low = vec3(1e30);
    nodes.high = nodes.box.high = vec3(-1e30);
    float turning2 = 0.0, bending2 = 0.0, v2 = 0.0, w2 = 0.0, leeway = 0.0;
    for (uint y = y0; y < y0 + ny; ++y)
        for (uint x = x0; x < x0 + nx; ++x) {
            const uint i = nodeOf(x, y);
            const vec3 p = POSITION(i).xyz, q = nodes.axes * (p - corner), v = VELOCITY(i).xyz;
            const vec4 w = headingAt(i);
            nodes.box.low = min(nodes.box.low, p);
            nodes.box.high = max(nodes.box.high, p);
            nodes.low = min(nodes.low, q);
            nodes.high = max(nodes.high, q);
            v2 = max(v2, dot(v, v));
            w2 = max(w2, dot(w.xyz, w.xyz));
            turning2 = max(turning2, dot(v - nodes.v, v - nodes.v));
            bending2 = max(bending2, dot(w.xyz - nodes.w, w.xyz - nodes.w));
            leeway = max(leeway, w.w);
        }
    nodes.turning = step.h * sqrt(turning2);
    nodes.bending = bounds.horizon * sqrt(bending2);
    nodes.still = push.thickness + push.margin + leeway;
    nodes.box.reach = nodes.still + max(step.h * sqrt(v2), bounds.horizon * sqrt(w2));
    return nodes;
}

// As find_faces would find it near one of the faces, or somewhat farther.
bool isNear(Nodes nodes, uint i) {
    const vec3 corner = POSITION(nodeOf(own.nodes & 255u, own.nodes >> 8 & 255u)).xyz;
    const vec4 w = headingAt(i);
    const float approach = max(step.h * length(VELOCITY(i).xyz - nodes.v) + nodes.turning, bounds.horizon * length(w.xyz - nodes.w) + nodes.bending);
    return isInBox(nodes.low, nodes.high, nodes.axes * (POSITION(i).xyz - corner), 1.001 * (nodes.still + RADIUS(i) + w.w + approach));
}

bool isNearAnyInGrid(Nodes nodes, Cells cells, Frame frame, uint total) {
    bool isNearAny = false;
    Search search = Search(0u, 0u, 0u);
    do {
        findInGrid(nodes.box, cells, frame, total, search);
        for (uint k = 0u; k < search.found; ++k) isNearAny = isNearAny || isNear(nodes, foundAt(k));
    } while (search.done < search.all && !isNearAny);
    return isNearAny;
}

bool isNearAny(Nodes nodes) {
    const uint total = START(push.cells), outside = apart[FACE_POINTS_APART];
    const Frame frame = frameOf(bounds, push.cells);
    Cells cells = Cells(ivec3(0), ivec3(-1), 0u);
    if (total > 0u) cells = cellsAround(nodes.box, frame);
    if (max(cells.points, outside) > FACE_MOST_POINTS) return true;
    for (uint k = 0u; k < outside; ++k) {
        const uint i = apart[FACE_POINTS_FIRST + k];
        if (isSought(i) && isNear(nodes, i)) return true;
    }
    return isNearAnyInGrid(nodes, cells, frame, total);
}

void leaveToFaces() {
    const uint before = atomicAdd(apart[FACE_POINTS_SEARCHING], own.pairCount), end = before + own.pairCount;
    for (uint k = 0u; k < own.pairCount; ++k) apart[FACE_POINTS_FIRST + push.points + before + k] = own.pairs + k;
    atomicMax(making[MAKING_FACES].groupsX, (push.loose + end + GROUP_SIZE - 1u) / GROUP_SIZE);
}

// A shape that is given up somewhat later than it is taken is not given up at once.
#define MORE_THAN_REACH 1.03
#define SUBSTEPS_AHEAD 8.0

void main() {
    const uint k = itemIndex(push.patches);
    if (k >= push.patches) return;
    own = patches[k];
    const bool isAlone = keepsApart(own, MORE_THAN_REACH * own.reach, SUBSTEPS_AHEAD, 0u, PATCH_REGION - 1u) && !isNearAny(nodesOfPatch());
    alone[k] = isAlone ? 1u : 0u;
    if (!isAlone) leaveToFaces();
}
