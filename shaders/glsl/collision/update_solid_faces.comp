#version 460
// Updates the faces of voxel bodies after a cut. A square belongs to the surface if exactly one of the cells on its
// two sides is whole: it then faces away from that cell, and searches for points near it. So the faces that a cut
// opens exist in the same step. Fragments have no faces.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "lattice/link_masks.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer SavedLinks { uint savedLinks[]; };
layout(std430, binding = 2) readonly buffer Parts { CutSolidFace parts[]; };
layout(std430, binding = 3) buffer Searched { uint searched[]; }; // ~0 = none
layout(std430, binding = 4) buffer Large { uint large[]; };       // the same
layout(std430, binding = 5) buffer Bounds { GridBounds bounds; };
layout(std430, binding = 6) readonly buffer Particles { uint particles[]; }; // one per slot
layout(std430, binding = 7) readonly buffer Pieces { uint pieces[]; };
layout(std430, binding = 8) buffer Faces { ContactFace faces[]; };
layout(std430, binding = 9) writeonly buffer Opened { uint opened[]; }; // by face: 1 = new, or a link at one of its corners has died
layout(std430, binding = 10) readonly buffer Corners { uint corners[]; }; // see rows_of.glsl
layout(std430, binding = 11) writeonly buffer CornerEnds { uint cornerEnds[]; };
layout(push_constant) uniform Push { CutFacesPush push; };

#include "collision/whole_cell.glsl"

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const CutSolidFace part = parts[item];
    const bool isAbove = isWholeCell(part.low), isBelow = isWholeCell(part.low - part.below);
    const uint left = isAbove != isBelow && pieces[particles[part.low]] != REMOVED_PIECE ? part.face : ~0u;
    const uint before = part.isLarge != 0u ? large[part.place] : searched[part.place];
    const ContactFace face = faces[part.face];
    const bool isNew = left != before || links[face.a] != savedLinks[face.a] || links[face.b] != savedLinks[face.b] ||
                       links[face.c] != savedLinks[face.c];
    opened[part.face] = isNew && left != ~0u ? 1u : 0u;
    if (!isNew) return;
    if (left != ~0u) { // from now on all faces around these corners count
        cornerEnds[face.a] = corners[face.a + 1u];
        cornerEnds[face.b] = corners[face.b + 1u];
        cornerEnds[face.c] = corners[face.c + 1u];
    }
    // The sign of a thickness of 0 counts too.
    const uint front = isBelow == (part.isFrontUp != 0u) ? 0u : 0x80000000u;
    if (left != ~0u) faces[part.face].thickness = uintBitsToFloat(floatBitsToUint(face.thickness) & 0x7fffffffu | front);
    if (part.isLarge != 0u) large[part.place] = left;
    else searched[part.place] = left;
    if (bounds.moved == 0u) atomicMax(bounds.moved, 1u);
}
