#version 460
// The surface of a cut: collapses skin triangles that are drawn in pieces to a point.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

#include "surface/skin_faces.glsl"
#include "common/fetched.glsl"
FETCHED_UINT(3, AllIndices, indexAt) // indices of the uncut skins
#define INDEX(n) indexAt(n)
layout(std430, binding = 4) writeonly buffer Indices { uint indices[]; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const SkinFace face = faceAt(i);
    const uvec3 corners = uvec3(INDEX(3u * face.triangle), INDEX(3u * face.triangle + 1u), INDEX(3u * face.triangle + 2u));
    const bool isHidden = isInPieces(face);
    for (uint n = 0u; n < 3u; ++n) indices[3u * face.triangle + n] = isHidden ? corners.x : corners[n];
}
