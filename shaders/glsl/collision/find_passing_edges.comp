#version 460
// Impact zones, search among edges: finds edges of two sheets that pass each other in the substep, or come so near that
// rounding may soon decide the side, after all contacts and constraints. Their four ends join one zone.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/kernel.glsl"
#include "common/segments.glsl"

layout(std430, binding = 0) readonly buffer Predicted { vec4 predicted[]; };
layout(std430, binding = 1) readonly buffer PredictedVelocities { vec4 predictedVelocities[]; }; // that led to those positions [m/s]
layout(std430, binding = 2) readonly buffer Positions { vec4 positions[]; };   // x + thetaH v
layout(std430, binding = 3) readonly buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std140, binding = 4) uniform Step { StepParams step; };
layout(std430, binding = 5) coherent volatile buffer Words { uint words[]; };
layout(std430, binding = 6) writeonly buffer Pairs { ZonePair pairs[]; };
layout(std430, binding = 7) readonly buffer Edges { ContactEdge edges[]; };
layout(std430, binding = 8) readonly buffer Contacts { uvec2 contacts[]; }; // ContactCandidate, in one load
layout(std430, binding = 9) readonly buffer Owners { uint owners[]; };      // one per element
layout(std430, binding = 10) writeonly buffer Solving { DispatchArguments solving[]; };
layout(std430, binding = 11) readonly buffer Meets { uint meeting[]; }; // by element of the lists (meeting_marks.glsl)
layout(std430, binding = 12) readonly buffer Sheets { uint sheets[]; };        // by slot (sheet_marks.h)
layout(std430, binding = 13) readonly buffer Thickness { float thickness[]; }; // by edge [m]
layout(std430, binding = 14) readonly buffer Looked { vec4 looked[]; };        // predicted positions before contacts between edges
layout(std140, binding = 15) uniform Bounds { GridBounds bounds; };
layout(push_constant) uniform Push { ZonePush push; };
#include "collision/row_items.glsl"
#include "collision/zone_edge_test.glsl"
#include "collision/zone_pairs.glsl"

void testPair(ContactEdge first, ContactEdge second, float reach) {
    const uvec4 all = uvec4(first.a, first.b, second.a, second.b);
    if (areSolved(all)) return;
    const float time = timeOfPassing(passageOf(first, second), reach);
    if (time <= 1.0) addPair(all, time);
}

// Distance by which a particle has been moved off the way on which edges in lists were looked at [m].
float thrownBy(uint i) {
    const vec4 velocity = velocities[i];
    return velocity.w == 0.0 ? 0.0 : length(positions[i].xyz - step.thetaH * velocity.xyz - looked[i].xyz);
}

// Whether an edge may pass others that are in no list. On that way two such edges are farther apart than both are thick:
// to meet, one of them must have been moved off it by as much as it is thick.
bool isThrown(uint e) {
    const ContactEdge edge = edges[e];
    if (edge.radius < 0.0) return false; // padding, or disabled by a cut
    return sheets[edge.a] != 0u && uintBitsToFloat(LOOSE(edge.a)) > 0.0 && max(thrownBy(edge.a), thrownBy(edge.b)) > 0.999 * thickness[e];
}

// Tests an edge with all of other sheets.
void searchAll(uint e) {
    const ContactEdge first = edges[e];
    for (uint f = 0u; f < edges.length(); ++f) {
        const ContactEdge second = edges[f];
        const uint sheet = sheets[second.a];
        if (second.radius >= 0.0 && sheet != 0u && sheet != sheets[first.a]) testPair(first, second, thickness[e] + thickness[f]);
    }
}

void main() {
    if (gl_GlobalInvocationID.x == 0u) solving[push.round].groupsX = 1u;
    for (uint e = gl_GlobalInvocationID.x; e < edges.length(); e += gl_NumWorkGroups.x * GROUP_SIZE)
        if (isThrown(e)) searchAll(e);
    FOR_EACH_ROW(row) {
        const uint element = elementOf(row);
        if (meeting[element] == 0u) continue;
        const uvec2 candidate = contacts[element];
        testPair(edges[owners[element]], edges[candidate.x], uintBitsToFloat(candidate.y));
    }
}
