#version 460
// The surface of a cut, last pass: triangles of a skin of which pieces are drawn instead shrink to a point. In a mixed skin so do those that
// whole triangles stand for, and it is known which vertices are seen.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Counts { SurfaceCounts counts[]; };
layout(std430, binding = 1) readonly buffer State { SurfaceState state; };
layout(std430, binding = 2) readonly buffer Faces { SkinFace faces[]; };
layout(std430, binding = 3) readonly buffer AllIndices { uint allIndices[]; }; // of the uncut skins
layout(std430, binding = 4) writeonly buffer Indices { uint indices[]; };
#ifdef MIXED
layout(std430, binding = 5) readonly buffer States { uint states[]; }; // of whole triangles
layout(std430, binding = 6) writeonly buffer MixedIndices { uint mixedIndices[]; };
layout(std430, binding = 7) buffer Shown { uint shown[]; };
#endif
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const SkinFace face = faces[i];
    const bool isHidden = state.missing == 0u && (counts[face.cell].pieces >> face.bit & 1u) != 0u;
    for (uint n = 0u; n < 3u; ++n) indices[3u * face.triangle + n] = allIndices[3u * face.triangle + (isHidden ? 0u : n)];
#ifdef MIXED
    const uint whole = face.whole == NO_WHOLE ? WHOLE_PARTED : states[face.whole];
    const bool isPart = whole == WHOLE_PARTED || whole == WHOLE_MIXED;
    for (uint n = 0u; n < 3u; ++n) {
        const uint vertex = allIndices[3u * face.triangle + n];
        mixedIndices[3u * face.mixed + n] = isPart && !isHidden ? vertex : 0u; // one vertex for all
        if (whole != WHOLE_ALONE) atomicMax(shown[vertex], isPart ? VERTEX_SHOWN : VERTEX_PLACED); // pieces of what is hidden go with it, too
    }
#endif
}
