#version 460
// The surface of a cut: collapses skin triangles that are drawn in pieces to a point. In a mixed skin, collapses
// triangles that whole triangles replace too, and marks the visible vertices.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

#include "skin_faces.glsl"
#ifdef TEXELS
layout(binding = 3) uniform usamplerBuffer allIndices; // indices of the uncut skins
#define INDEX(n) texelFetch(allIndices, int(n)).x
#else
layout(std430, binding = 3) readonly buffer AllIndices { uint allIndices[]; };
#define INDEX(n) allIndices[n]
#endif
layout(std430, binding = 4) writeonly buffer Indices { uint indices[]; };
#ifdef MIXED
layout(std430, binding = 5) readonly buffer States { uint states[]; }; // one per whole triangle
layout(std430, binding = 6) writeonly buffer MixedTriangles { uint mixedTriangles[]; };
layout(std430, binding = 7) buffer Shown { uint shown[]; };
#endif
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const SkinFace face = faceAt(i);
    const uvec3 corners = uvec3(INDEX(3u * face.triangle), INDEX(3u * face.triangle + 1u), INDEX(3u * face.triangle + 2u));
    const bool isHidden = isInPieces(face);
    for (uint n = 0u; n < 3u; ++n) indices[3u * face.triangle + n] = isHidden ? corners.x : corners[n];
#ifdef MIXED
    const uint whole = face.whole == NO_WHOLE ? WHOLE_PARTED : states[face.whole];
    const bool isPart = whole == WHOLE_PARTED || whole == WHOLE_MIXED;
    for (uint n = 0u; n < 3u; ++n) {
        mixedTriangles[3u * face.mixed + n] = isPart && !isHidden ? corners[n] : 0u; // one vertex for all three
        if (isPart) atomicOr(shown[corners[n]], VERTEX_PLACED | VERTEX_SHOWN); // pieces of hidden triangles use these vertices too
    }
#endif
}
