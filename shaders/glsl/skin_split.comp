#version 460
// Vertices of skins in cells that a cut has parted (list_split): over skin_cells, which goes before.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "cut.glsl"
#include "link_masks.glsl"
#include "kuhn.glsl"

#include "skin_material.glsl"

#ifdef TEXELS
layout(binding = 0) uniform usamplerBuffer hung; // HungVertex
layout(binding = 7) uniform samplerBuffer moved;
#define MOVED(v) texelFetch(moved, int(v))
HungVertex hungAt(uint v) {
    const int h = int(4u * v);
    const uvec4 words = texelFetch(hung, h + 3);
    return HungVertex(uintBitsToFloat(texelFetch(hung, h)), uintBitsToFloat(texelFetch(hung, h + 1)), uintBitsToFloat(texelFetch(hung, h + 2)),
                      words.x, words.y, words.z, words.w);
}
#else
layout(std430, binding = 0) readonly buffer Hung { HungVertex hung[]; };
layout(std430, binding = 7) readonly buffer Moved { vec4 moved[]; };
#define MOVED(v) moved[v]
HungVertex hungAt(uint v) { return hung[v]; }
#endif
layout(std430, binding = 8) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 9) readonly buffer Listed { uint listed[]; };
layout(std430, binding = 10) writeonly buffer Vertices { SkinVertex vertices[]; };

#define ALIVE(i) LINKS(i)
#define REST(i) HOME(i)
#include "skin_place.glsl"

#include "nearby.glsl"

void main() {
    const uint count = counts[SKIN_LISTS * push.run + SKIN_SPLIT], item = itemIndex(count);
    if (item >= count) return;
    const uint v = listed[push.first + item];
    const HungVertex vertex = hungAt(v);
    const vec4 to = MOVED(v);
    if (to.w == VERTEX_MOVED) { // onto a rim
        const SkinGrid grid = SkinGrid(push.rowStride, push.sliceStride, push.spacing, 0u);
        vertices[vertex.vertex].position.xyz = nearbyOf(vertex.anchor, to.xyz, to.xyz, grid).place;
        return;
    }
    const uint held = heldWith(vertex.cell, vertex.corner);
    if (held != 255u) vertices[vertex.vertex].position.xyz = placeOf(vertex, held);
}
