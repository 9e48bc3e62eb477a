#version 460
// Vertices of skins in cells that a cut has parted (list_split): over skin_cells, which goes before.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "cut.glsl"
#include "link_masks.glsl"
#include "kuhn.glsl"

layout(std430, binding = 0) readonly buffer Hung { HungVertex hung[]; };
layout(std430, binding = 1) readonly buffer Links { uint links[]; };
layout(std430, binding = 2) readonly buffer Rest { vec4 rest[]; };
layout(std430, binding = 3) readonly buffer Particles { uint particles[]; }; // of each slot
layout(std430, binding = 4) readonly buffer Positions { vec4 positions[]; }; // of each particle
layout(std430, binding = 5) readonly buffer Gradients { Gradient gradients[]; };
layout(std430, binding = 6) buffer Vertices { SkinVertex vertices[]; };
layout(std430, binding = 7) readonly buffer Moved { vec4 moved[]; };
layout(std430, binding = 8) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 9) readonly buffer Listed { uint listed[]; };
layout(std430, binding = 10) readonly buffer Near { uint near[]; };

mat3 matrixOf(Gradient g) { return mat3(g.x.xyz, g.y.xyz, g.z.xyz); }

#define ALIVE(i) links[i]
#define AT(i) positions[particles[i]].xyz
#define REST(i) rest[i].xyz
#define TURN(i) matrixOf(gradients[i])
#include "skin_place.glsl"

#include "nearby.glsl"

void main() {
    const uint count = counts[SKIN_LISTS * push.run + SKIN_SPLIT], item = itemIndex(count);
    if (item >= count) return;
    const uint v = listed[push.first + item];
    const HungVertex vertex = hung[v];
    if (moved[v].w == VERTEX_MOVED) { // onto a rim
        const SkinGrid grid = SkinGrid(push.rowStride, push.sliceStride, push.spacing, 0u);
        vertices[vertex.vertex].position.xyz = nearbyOf(vertex.anchor, moved[v].xyz, moved[v].xyz, grid).place;
        return;
    }
    const uint held = heldWith(vertex.cell, vertex.corner);
    if (held != 255u) vertices[vertex.vertex].position.xyz = placeOf(vertex, held);
}
