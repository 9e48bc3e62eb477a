#version 460
// Split skins, first pass: marks the whole triangles beside a cut. They are those with a part that is drawn in pieces, or that has a
// corner that moved onto the rim or lies in a cell that the cut divides.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

#include "surface/skin_faces.glsl"
#define PRISM_BINDING 3
#include "surface/skin_prism.glsl"
#define HUNG_BINDING 4
#include "surface/hung_vertex.glsl"
#define MOVED_BINDING 5
#include "surface/moved_vertex.glsl"
#include "common/fetched.glsl"
FETCHED_UINT(6, Partitions, partitionAt)
#define PARTITION(cell) partitionAt(cell)
layout(std430, binding = 7) writeonly buffer States { uint states[]; }; // one per whole triangle
layout(push_constant) uniform Push { PrismPush push; };

bool isBesideCut(uint v) { return PARTITION(hungAt(v).cell) != 0u || MOVED(v).w >= VERTEX_MOVED; }

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const SkinFace face = faceAt(i);
    if (face.whole == NO_WHOLE) return;
    const uint corners[3] = prismAt(cellOf(face) - push.first).vertices; // the surface item of a part is a prism
    if (isInPieces(face) || isBesideCut(corners[0]) || isBesideCut(corners[1]) || isBesideCut(corners[2])) states[face.whole] = WHOLE_PARTED;
}
