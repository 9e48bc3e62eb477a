#version 460
// Hides fragments in the surface of cuts.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "cutting/debris.glsl"
layout(std430, binding = 6) readonly buffer State { SurfaceState state; };
layout(std430, binding = 7) readonly buffer CutVertices { CutVertex cutVertices[]; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint count = min(push.count, state.points + 3u * state.outside), i = itemIndex(count);
    if (i >= count) return;
    const CutVertex vertex = cutVertices[i];
    hide(i, vertex.point >> 30 == 1u ? slots[vertex.point ^ SURFACE_SKIN] : vertex.corners[0]);
}
