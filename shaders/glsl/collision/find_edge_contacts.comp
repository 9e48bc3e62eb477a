#version 460
// Contacts between edges, first pass: finds pairs whose interiors are nearer than the thickness of their faces, over
// the whole path of the substep; all other contacts of two faces involve a corner (find_face_contacts). Two lines that cross
// have two sides of each other, and the two stay on those on which they met, like a point and a face. Nearly parallel
// edges and those that have moved around each other lose this memory.
//
//   C = n . (x_1(s) - x_2(t)) - reach,   beta = 1 - s, s, -(1 - t), -t for the four ends.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/segments.glsl"

#include "common/fetched.glsl"
FETCHED_VEC4(0, Predicted, predictedAt)
FETCHED_VEC4(1, Velocities, velocityAt)
layout(std430, binding = 2) readonly buffer Edges { ContactEdge edges[]; };
TEXEL_TWIN(2, usamplerBuffer, edgeTexels);
FETCHED_UVEC2(3, Contacts, contactAt) // ContactCandidate
FETCHED_VEC4(5, Memory, memoryAt)     // w: side and overlap, 0 = no contact so far
#define PREDICTED(i) predictedAt(i)
#define VELOCITY(i) velocityAt(i)
#define CONTACT(k) contactAt(k)
#define MEMORY(k) memoryAt(k)
#include "collision/edge_at.glsl"
layout(std430, binding = 4) readonly buffer Lists { uvec2 lists[]; };           // one per edge: first element that it owns, count
layout(std430, binding = 6) writeonly buffer Directions { vec4 directions[]; }; // n from the other to the owner, depth [m]; 0 = none
layout(std430, binding = 7) writeonly buffer Weights { vec4 weights[]; };       // s of the owner, t of the other edge; w: new memory
layout(std140, binding = 8) uniform Step { StepParams step; };
#define SHEETS_BINDING 13
#include "collision/one_sheet.glsl"
layout(constant_id = 5) const bool hasZones = false; // edges of two sheets may pass each other; else bindings 14 and 15 are empty
layout(std430, binding = 14) buffer Finding { DispatchArguments finding[]; }; // of the search for edges that pass
layout(std430, binding = 15) writeonly buffer Meets { uint meeting[]; };                // by element, see meeting_marks.glsl
layout(std430, binding = 16) readonly buffer Touched { uint touched[]; };
#include "collision/touched.h"
#include "collision/touched.glsl"
layout(push_constant) uniform Push { FacePush push; };
#define MARKS_BINDING 9
#include "collision/keeps_rest.glsl"
#include "collision/recovery.glsl"
layout(std430, binding = 10) readonly buffer Owners { uint owners[]; };        // one per element
layout(std430, binding = 11) readonly buffer Links { uint links[]; };          // elements that others own
layout(std430, binding = 12) readonly buffer LinkLists { uvec2 linkLists[]; }; // ranges in links, by edge
#include "collision/edge_touch.glsl"

void main() {
    FOR_EACH_TOUCHED_ROW(row) {
        const uint element = touchedRow(row);
        const uvec2 candidate = CONTACT(element);
        meets = 0u;
        const Touch touch = touchOf(uvec2(owners[element], candidate.x), uintBitsToFloat(candidate.y), MEMORY(element).w);
        directions[element] = vec4(touch.n, touch.depth);
        weights[element] = vec4(touch.st, 0.0, touch.remembered);
        if (!hasZones) continue;
        meeting[element] = meets;
        mayPass = mayPass || meets != 0u && touch.depth > push.quick;
    }
    if (hasZones && mayPass) finding[ZONE_OF_EDGES].groupsX = finding[ZONE_GROUPS + 1].groupsX;
}
