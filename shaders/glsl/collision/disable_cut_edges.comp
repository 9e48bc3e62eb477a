#version 460
// Disables the edges of a sheet whose link is dead, or whose piece was removed, by a radius below 0, and enables them
// again when links are restored. If links at an edge have changed, all lists are rebuilt.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "lattice/link_masks.glsl"

layout(std430, binding = 0) readonly buffer Links { uint links[]; };
layout(std430, binding = 1) readonly buffer SavedLinks { uint savedLinks[]; };
layout(std430, binding = 2) readonly buffer CutEdges { CutEdge cutEdges[]; };
layout(std430, binding = 3) readonly buffer Radii { float radii[]; };
layout(std430, binding = 4) buffer Edges { ContactEdge edges[]; };
layout(std430, binding = 5) buffer Bounds { GridBounds bounds; };
layout(std430, binding = 6) readonly buffer Particles { uint particles[]; }; // one per slot
layout(std430, binding = 7) readonly buffer Pieces { uint pieces[]; };
layout(push_constant) uniform Push { CutFacesPush push; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const CutEdge edge = cutEdges[item];
    const int bit = bitTo(int(edge.way), 0u, push.sliceStride);
    const bool isThere = (links[edge.slot] >> bit & 1u) != 0u && pieces[particles[edge.slot]] != REMOVED_PIECE;
    edges[edge.edge].radius = isThere ? radii[edge.edge] : -1.0;
    if (links[edge.slot] != savedLinks[edge.slot] && bounds.moved == 0u) atomicMax(bounds.moved, 1u);
}
