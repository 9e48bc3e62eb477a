#version 460
// Mixed skins, first pass: whole triangles that their parts stand for, since pieces stand for one of these or it may not be where the
// whole triangle has it, beside a cut.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

#include "skin_faces.glsl"
#ifdef TEXELS
layout(binding = 3) uniform usamplerBuffer prisms; // SkinPrism
layout(binding = 4) uniform usamplerBuffer hung;   // HungVertex
layout(binding = 5) uniform samplerBuffer moved;
layout(binding = 6) uniform usamplerBuffer partitions;
#define VERTICES(p) texelFetch(prisms, int(3u * (p))).xyz
bool isBesideCut(uint v) {
    return texelFetch(partitions, int(texelFetch(hung, int(4u * v + 3u)).y)).x != 0u || texelFetch(moved, int(v)).w == VERTEX_MOVED;
}
#else
layout(std430, binding = 3) readonly buffer Prisms { SkinPrism prisms[]; };
layout(std430, binding = 4) readonly buffer Hung { HungVertex hung[]; };
layout(std430, binding = 5) readonly buffer Moved { vec4 moved[]; };
layout(std430, binding = 6) readonly buffer Partitions { uint partitions[]; };
#define VERTICES(p) uvec3(prisms[p].vertices[0], prisms[p].vertices[1], prisms[p].vertices[2])
bool isBesideCut(uint v) { return partitions[hung[v].cell] != 0u || moved[v].w == VERTEX_MOVED; }
#endif
layout(std430, binding = 7) writeonly buffer States { uint states[]; }; // of whole triangles
layout(push_constant) uniform Push { PrismPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const SkinFace face = faceAt(i);
    if (face.whole == NO_WHOLE) return;
    const uvec3 corners = VERTICES(cellOf(face) - push.first); // its item of the surface is a prism
    const bool isParted = state.missing == 0u && PIECES(cellOf(face)) != 0u;
    if (isParted || isBesideCut(corners.x) || isBesideCut(corners.y) || isBesideCut(corners.z)) states[face.whole] = WHOLE_PARTED;
}
