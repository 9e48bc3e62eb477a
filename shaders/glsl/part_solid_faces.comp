#version 460
// Likewise of voxel bodies: a face of which a cut has parted a corner from the others leaves the list of those that look for points
// near them, and so do the faces of crumbs.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer SavedLinks { uint savedLinks[]; };
layout(std430, binding = 2) readonly buffer Faces { CutSolidFace faces[]; };
layout(std430, binding = 3) writeonly buffer Searched { uint searched[]; }; // ~0 = none
layout(std430, binding = 4) writeonly buffer Large { uint large[]; };       // likewise
layout(std430, binding = 5) buffer Bounds { GridBounds bounds; };
layout(std430, binding = 6) readonly buffer Particles { uint particles[]; }; // of each slot
layout(std430, binding = 7) readonly buffer Pieces { uint pieces[]; };
layout(push_constant) uniform Push { CutFacesPush push; };

uint isDead(uint slot, uint bit) { return 1u - (links[slot] >> (bit & 255u) & 1u); }

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const CutSolidFace face = faces[item];
    const uint dead = isDead(face.low, face.bits) + isDead(face.low, face.bits >> 8) + isDead(face.middle, face.bits >> 16);
    const uint left = dead < 2u && pieces[particles[face.low]] != REMOVED_PIECE ? face.face : ~0u;
    if (face.isLarge != 0u) large[face.place] = left;
    else searched[face.place] = left;
    const bool isNew = links[face.low] != savedLinks[face.low] || links[face.middle] != savedLinks[face.middle];
    if (isNew && bounds.moved == 0u) atomicMax(bounds.moved, 1u);
}
