#version 460
// Impact zones, search: finds loose points, and corners of sheets at other sheets, whose path in the substep leads
// through a face, or so near to it that rounding may soon decide the side, after all contacts and constraints. Such a
// point and the corners of the face join one zone.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define RUNS_LISTED
#include "common/kernel.glsl"
#include "common/triangle.glsl"

layout(std430, binding = 0) readonly buffer Predicted { vec4 predicted[]; };
layout(std430, binding = 1) readonly buffer PredictedVelocities { vec4 predictedVelocities[]; }; // that led to those positions [m/s]
layout(std430, binding = 2) readonly buffer Positions { vec4 positions[]; };   // x + thetaH v
layout(std430, binding = 3) readonly buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std140, binding = 4) uniform Step { StepParams step; };
layout(std430, binding = 5) coherent volatile buffer Words { uint words[]; };
layout(std430, binding = 6) writeonly buffer Pairs { ZonePair pairs[]; };
layout(std430, binding = 7) readonly buffer Faces { ContactFace faces[]; };
layout(std430, binding = 8) readonly buffer Contacts { uvec2 contacts[]; }; // ContactCandidate, in one load
layout(std430, binding = 9) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 10) writeonly buffer Solving { DispatchArguments solving[]; };
layout(std430, binding = 11) readonly buffer SearchedFaces { uint searchedFaces[]; }; // small faces that exist; ~0 = none
layout(std430, binding = 12) readonly buffer Large { uint large[]; };                 // wide ones
layout(std430, binding = 13) readonly buffer Meets { uint meeting[]; }; // by element of lists (meeting_marks.glsl)
layout(push_constant) uniform Push { ZonePush push; };
#define SHEETS_BINDING 14
#include "collision/one_sheet.glsl"
#include "collision/meeting_marks.glsl"
#include "collision/zone_test.glsl"
#include "collision/zone_pairs.glsl"

// A sheet is kept from itself by separations, and contacts alone hold it at faces of bodies.
bool isLeftOut(uint i, uint f, ContactFace face) {
    return hasSheets && sheets[i] != 0u && (f >= push.sheets || areOneSheet(i, face.a));
}

// Tests a point with a face that it touches at distances below `reach`; the sign bit is that of the thickness.
void testPair(uint i, Path point, uint f, float reach) {
    const ContactFace face = faces[f];
    const uvec4 all = uvec4(i, face.a, face.b, face.c);
    if (areSolved(all) || isLeftOut(i, f, face)) return;
    const bool isSolid = f >= push.sheets && f < push.moving;
    const float front = floatBitsToUint(reach) >> 31 != 0u ? -1.0 : 1.0;
    const float time = timeOfPassing(passageOf(point, face), abs(reach), isSolid ? front : 0.0);
    if (time <= 1.0) addPair(all, time);
}

void searchFace(uint i, Path point, uint f) {
    if (f >= push.moving) return; // it never moves, or a cut has removed it
    const float thickness = faces[f].thickness, radius = uintBitsToFloat(LOOSE(i));
    testPair(i, point, f, uintBitsToFloat(floatBitsToUint(radius + abs(thickness)) | floatBitsToUint(thickness) & 0x80000000u));
}

void searchAll(uint i, Path point) {
    for (uint s = 0u; s < searchedFaces.length(); ++s) searchFace(i, point, searchedFaces[s]);
    for (uint l = 0u; l < push.large; ++l) searchFace(i, point, large[l]);
}

void main() {
    const uint i = itemIndex(push.count);
    if (gl_WorkGroupID.x == 0u && gl_LocalInvocationID.x == 0u) solving[push.round].groupsX = 1u;
    if (LOOSE(i) == 0u) return;
    const Path point = pathOf(i);
    const uvec2 list = lists[i];
    uint mark = 0u; // the largest
    for (uint element = list.x; element < list.x + list.y; ++element) mark = max(mark, meeting[element]);
    const bool isCorner = hasSheets && sheets[i] != 0u;
    // Contacts may throw it through faces that are in no list.
    if (mark >= (isCorner ? MEETS_FAST : MEETS) && uintBitsToFloat(LOOSE(i)) > 0.0) {
        searchAll(i, point);
        return;
    }
    for (uint element = list.x; element < list.x + list.y; ++element)
        if (meeting[element] != 0u) testPair(i, point, contacts[element].x, uintBitsToFloat(contacts[element].y));
}
