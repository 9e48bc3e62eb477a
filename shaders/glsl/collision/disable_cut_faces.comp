#version 460
// Removes the faces of a sheet between corners separated by a cut from the list of faces that search for points, and
// adds them again when links are restored; removes faces of fragments too. If links around a face have changed, all
// lists are rebuilt.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer SavedLinks { uint savedLinks[]; };
layout(std430, binding = 2) readonly buffer Faces { CutFace faces[]; };
layout(std430, binding = 3) writeonly buffer Searched { uint searched[]; }; // ~0 = none
layout(std430, binding = 4) writeonly buffer Large { uint large[]; };       // the same
layout(std430, binding = 5) buffer Bounds { GridBounds bounds; };
layout(std430, binding = 6) readonly buffer Particles { uint particles[]; }; // one per slot
layout(std430, binding = 7) readonly buffer Pieces { uint pieces[]; };
layout(push_constant) uniform Push { CutFacesPush push; };
#include "lattice/sheet_edges.glsl"

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const CutFace face = faces[item];
    const Cuts cuts = cutsOf(SheetTriangle(face.slot, face.kind));
    const uint left = cuts.dead < 2u && pieces[particles[face.slot]] != REMOVED_PIECE ? face.face : ~0u;
    if (face.isLarge != 0u) large[face.place] = left;
    else searched[face.place] = left;
    bool isNew = false;
    for (int n = 0; n < 3; ++n) isNew = isNew || links[cuts.edges[n].owner] != savedLinks[cuts.edges[n].owner];
    if (isNew && bounds.moved == 0u) atomicMax(bounds.moved, 1u);
}
