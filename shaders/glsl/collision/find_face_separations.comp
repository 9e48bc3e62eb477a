#version 460
// Separations of sheets, first pass: limits the ways of a corner of a sheet and the faces of the same sheet in its list
// (separation.glsl).
#extension GL_GOOGLE_include_directive : require
#define RUNS_LISTED
#include "common/kernel.glsl"
#include "common/triangle.glsl"

#include "collision/near_faces.glsl"
FETCHED_VEC4(4, Positions, positionAt)  // x + thetaH v
FETCHED_VEC4(5, Velocities, velocityAt) // w = inverse mass [1/kg]
#define POSITION(i) positionAt(i)
#define VELOCITY(i) velocityAt(i)
layout(std430, binding = 6) readonly buffer Directions { vec4 directions[]; }; // w: not 0 if the pair touches
layout(std430, binding = 7) buffer Parts { uint parts[]; };                   // by slot: bits of the part of its way that it may go
layout(std140, binding = 8) uniform Step { StepParams step; };
#define SPEEDS_BINDING 9
layout(std430, binding = 12) readonly buffer Lists { uvec2 lists[]; };
layout(push_constant) uniform Push { FacePush push; };
#define TOUCHED_LIST TOUCHED_POINTS
#include "collision/touched.h"
#include "collision/touched.glsl"
#include "collision/separation.glsl"

void separate(Corner point, vec3 along, uvec2 candidate, bool touches) {
    const ContactFace corners = faceAt(candidate.x);
    if (sheets[corners.a] != sheets[point.index]) return;
    const Corner a = cornerOf(corners.a), b = cornerOf(corners.b), c = cornerOf(corners.c);
    const Nearest nearest = nearestOf(point.start - a.start, triangleOf(b.start - a.start, c.start - a.start));
    const float reach = abs(uintBitsToFloat(candidate.y));
    const Plane plane = planeBetween(point.start, nearest.d, reach);
    if (isLeftOut(plane, reach, touches)) return;
    const vec3 pair = 0.5 * (point.way + (a.way + b.way + c.way) / 3.0);
    const float lowest = min(heightAfter(a, plane, -1.0, pair, 1.0), min(heightAfter(b, plane, -1.0, pair, 1.0), heightAfter(c, plane, -1.0, pair, 1.0)));
    if (min(heightAfter(point, plane, 1.0, pair, 1.0), lowest) >= plane.least) return;
    limit(point, plane, 1.0, along);
    limit(a, plane, -1.0, along);
    limit(b, plane, -1.0, along);
    limit(c, plane, -1.0, along);
}

void main() {
    const uint i = touchedItem();
    if (i == ~0u || sheets[i] == 0u) return;
    const uvec2 list = lists[i];
    const Corner point = cornerOf(i);
    const vec3 along = step.h * sheetSpeedOf(i);
    for (uint element = list.x; element < list.x + list.y; ++element) {
        const uvec2 candidate = CONTACT(element);
        if (candidate.x < push.sheets) separate(point, along, candidate, directions[element].w != 0.0);
    }
}
