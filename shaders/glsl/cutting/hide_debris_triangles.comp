#version 460
// Collapses triangles of unclipped skins to a point if any of their particles was removed: triangles at the rim would
// follow invisible particles.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Triangles { DebrisTriangle triangles[]; };
layout(std430, binding = 1) readonly buffer Holders { uint holders[]; }; // particles
layout(std430, binding = 2) readonly buffer Pieces { uint pieces[]; };
layout(std430, binding = 3) writeonly buffer Indices { uint indices[]; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const DebrisTriangle triangle = triangles[i];
    bool isGone = false;
    for (uint h = triangle.first; h < triangle.first + triangle.count; ++h) isGone = isGone || pieces[holders[h]] == REMOVED_PIECE;
    for (uint n = 0u; n < 3u; ++n) indices[triangle.place + n] = triangle.corners[isGone ? 0u : n];
}
