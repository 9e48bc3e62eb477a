#version 460
// Contacts between edges, before the first pass: lists the pairs that may touch in this substep, or that remember a
// contact, and their particles. Most candidates touch nothing, and the narrow phase costs many times this test. All other
// pairs touch nothing.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/rest_slack.h"
#include "common/segments.glsl"

#include "common/fetched.glsl"
FETCHED_VEC4(0, Predicted, predictedAt)
FETCHED_VEC4(1, Velocities, velocityAt)
layout(std430, binding = 2) readonly buffer Edges { ContactEdge edges[]; };
TEXEL_TWIN(2, usamplerBuffer, edgeTexels);
FETCHED_UVEC2(3, Contacts, contactAt) // ContactCandidate
FETCHED_VEC4(5, Memory, memoryAt)
#define PREDICTED(i) predictedAt(i)
#define VELOCITY(i) velocityAt(i)
#define CONTACT(k) contactAt(k)
#define MEMORY(k) memoryAt(k)
#include "collision/edge_at.glsl"
layout(std430, binding = 4) readonly buffer Owners { uint owners[]; };      // one per element
layout(std430, binding = 6) buffer Directions { vec4 directions[]; };       // n, depth [m]; 0 = does not touch
layout(std140, binding = 7) uniform Step { StepParams step; };
layout(constant_id = 1) const bool keepsRest = false; // pairs keep overlaps
layout(constant_id = 5) const bool hasZones = false;  // edges of two sheets may pass each other; else the next two are empty
layout(std430, binding = 8) writeonly buffer Finding { DispatchArguments finding[]; }; // of the search for such edges
layout(std430, binding = 9) writeonly buffer Meets { uint meeting[]; };                // by element, see meeting_marks.glsl
#define TOUCHED_BINDING 10
#define FIRST_TOUCHED TOUCHED_PARTICLES
#include "collision/touched.h"
#include "collision/touched.glsl"
layout(std140, binding = 12) uniform Bounds { GridBounds bounds; };
#include "collision/row_items.glsl"
layout(push_constant) uniform Push { FacePush push; };

// False only if two edges stay out of reach of each other in the whole substep: a plane square to their shortest distance
// at its end keeps them apart at its start as well.
bool mayTouch(ContactEdge first, ContactEdge second, float reach) {
    const vec3 xc = PREDICTED(second.a).xyz, vc = step.h * VELOCITY(second.a).xyz;
    const vec3 a = PREDICTED(first.a).xyz - xc, b = PREDICTED(first.b).xyz - xc, d = PREDICTED(second.b).xyz - xc;
    const vec3 way = shortestBetween(a, b - a, d); // from the second edge to the first
    const vec3 beforeA = a - (step.h * VELOCITY(first.a).xyz - vc), beforeB = b - (step.h * VELOCITY(first.b).xyz - vc),
               beforeD = d - (step.h * VELOCITY(second.b).xyz - vc);
    const float before = min(dot(way, beforeA), dot(way, beforeB)) - max(0.0, dot(way, beforeD)); // times |way|
    return !(min(before, dot(way, way)) > 1.001 * reach * length(way));
}

void listRow(uint element, ContactEdge first, ContactEdge second) {
    listTouched(TOUCHED_ROWS, element);
    listTouchedParticles(first.a, first.b, second.a, second.b);
}

void main() {
    if (hasZones && gl_GlobalInvocationID.x == 0u) finding[ZONE_GROUPS + 1].groupsX = gl_NumWorkGroups.x;
    FOR_EACH_ROW(row) {
        const uint element = elementOf(row);
        const uvec2 candidate = CONTACT(element);
        const ContactEdge first = edgeAt(owners[element]), second = edgeAt(candidate.x);
        const float reach = uintBitsToFloat(candidate.y);
        if (mayTouch(first, second, keepsRest ? (1.0 + REST_SLACK) * reach : reach) || MEMORY(element) != vec4(0.0)) {
            listRow(element, first, second);
            continue;
        }
        if (directions[element].w != 0.0) directions[element] = vec4(0.0);
        if (hasZones) meeting[element] = 0u;
    }
}
