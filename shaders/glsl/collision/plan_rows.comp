#version 460
// Plans the passes that make lists of the pairs of points and faces, or of edges, that were found. Reports a lack of
// capacity.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) buffer Points { uint apart[]; }; // FACE_POINTS_...
layout(std430, binding = 1) buffer Bounds { GridBounds bounds; };
layout(std430, binding = 2) buffer Status { StatusWords status; };
layout(std430, binding = 3) writeonly buffer Making { DispatchArguments making[]; };
layout(std430, binding = 4) writeonly buffer Touching { DispatchArguments touching[]; };
layout(push_constant) uniform Push { FaceFindPush push; };
#include "collision/motion_classes.glsl"
#include "collision/row_kind.glsl"

// Points that go far along their headings make every search wide: the next lists look less far ahead.
void planHorizon() {
    const float far = 4.0 * uintBitsToFloat(apart[FACE_POINTS_UNIT]), most = mostMotion();
    const float share = 1.0 + bounds.aheadShare;
    bounds.aheadShare = (most > far ? max(0.7 * share, 0.125) : min(1.4 * share, 1.0)) - 1.0;
}

// The mean number of entries per owner that would be needed, if that exceeds the capacity. Only the first lists of a step
// that lack capacity report it: after pairs were lost later results depend on which, and counting stops somewhere beyond 4
// times the capacity.
void reportLack(uint found) {
    if (found > push.room && status.candidates == 0u) status.candidates = (found - 1u) / push.points + 1u;
}

uint groupsOf(uint items) { return (items + GROUP_SIZE - 1u) / GROUP_SIZE; }

void main() {
    if (gl_GlobalInvocationID.x != 0u) return;
    planHorizon();
    for (uint k = 0u; k < FACE_POINTS_FIRST; ++k) apart[k] = 0u; // for the next build
    const uint found = min(bounds.pairs, 4u * push.room + 1u);
    reportLack(found);
    making[MAKING_OWNERS] = DispatchArguments(groupsOf(bounds.owners), 1u, 1u, 0u);
    making[MAKING_LINKS] = DispatchArguments(groupsOf(areEdges ? max(bounds.owners, bounds.linked) : bounds.linked), 1u, 1u, 0u);
    touching[2] = DispatchArguments(min(groupsOf(min(found, push.room)), uint(ROWS_MOST_GROUPS)), 1u, 1u, 0u);
}
