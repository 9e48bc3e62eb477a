#version 460
// Separations of sheets, first pass for edges: limits the ways of two edges of one sheet (separation.glsl).
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/segments.glsl"

#include "common/fetched.glsl"
FETCHED_VEC4(0, Predicted, predictedAt)
FETCHED_VEC4(1, PredictedVelocities, predictedVelocityAt) // that led to those positions [m/s]
#define PREDICTED(i) predictedAt(i)
#define PREDICTED_VELOCITY(i) predictedVelocityAt(i)
layout(std430, binding = 2) readonly buffer Edges { ContactEdge edges[]; };
layout(std430, binding = 3) readonly buffer Contacts { uvec2 contacts[]; }; // ContactCandidate, in one load
FETCHED_VEC4(4, Positions, positionAt)  // x + thetaH v
FETCHED_VEC4(5, Velocities, velocityAt) // w = inverse mass [1/kg]
#define POSITION(i) positionAt(i)
#define VELOCITY(i) velocityAt(i)
layout(std430, binding = 6) readonly buffer Directions { vec4 directions[]; }; // w: not 0 if the pair touches
layout(std430, binding = 7) buffer Parts { uint parts[]; };                   // by slot: bits of the part of its way that it may go
layout(std140, binding = 8) uniform Step { StepParams step; };
#define SPEEDS_BINDING 9
layout(std430, binding = 12) readonly buffer Owners { uint owners[]; }; // one per element
layout(std430, binding = 13) readonly buffer Touched { uint touched[]; };
#include "collision/touched.h"
#include "collision/touched.glsl"
layout(push_constant) uniform Push { FacePush push; };
#include "collision/separation.glsl"

// Lists are complete for the balls around the edges.
bool ballsMeet(ContactEdge one, ContactEdge other) {
    const vec3 apart = 0.5 * (PREDICTED(one.a).xyz + PREDICTED(one.b).xyz - PREDICTED(other.a).xyz - PREDICTED(other.b).xyz);
    return dot(apart, apart) < (one.radius + other.radius) * (one.radius + other.radius);
}

void separate(ContactEdge one, ContactEdge other, float reach, bool touches) {
    if (sheets[one.a] == 0u || sheets[one.a] != sheets[other.a] || !(touches || ballsMeet(one, other))) return;
    const Corner a = cornerOf(one.a), b = cornerOf(one.b), c = cornerOf(other.a), d = cornerOf(other.b);
    const vec3 way = shortestBetween(a.start - c.start, b.start - a.start, d.start - c.start);
    const vec3 nearer = dot(way, b.start - a.start) < 0.0 ? b.start : a.start;
    const Plane plane = planeBetween(nearer, way, reach);
    if (isLeftOut(plane, reach, touches)) return;
    const vec3 pair = 0.25 * (a.way + b.way + c.way + d.way), along = step.h * sheetSpeedOf(one.a);
    const float first = min(heightAfter(a, plane, 1.0, pair, 1.0), heightAfter(b, plane, 1.0, pair, 1.0));
    const float second = min(heightAfter(c, plane, -1.0, pair, 1.0), heightAfter(d, plane, -1.0, pair, 1.0));
    if (min(first, second) >= plane.least) return;
    limit(a, plane, 1.0, along);
    limit(b, plane, 1.0, along);
    limit(c, plane, -1.0, along);
    limit(d, plane, -1.0, along);
}

void main() {
    FOR_EACH_TOUCHED_ROW(row) {
        const uint element = touchedRow(row);
        const uvec2 candidate = contacts[element];
        separate(edges[owners[element]], edges[candidate.x], uintBitsToFloat(candidate.y), directions[element].w != 0.0);
    }
}
