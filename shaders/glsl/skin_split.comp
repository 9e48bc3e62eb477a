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

#define ALIVE(i) links[i]
#define AT(i) positions[particles[i]].xyz
#define REST(i) rest[i].xyz
#define TURN(i) mat3(gradients[i].x.xyz, gradients[i].y.xyz, gradients[i].z.xyz)
#include "skin_place.glsl"
#include "skin_rest.glsl"

void main() {
    const uint count = counts[SKIN_LISTS * push.run + SKIN_SPLIT], item = itemIndex(count);
    if (item >= count) return;
    const uint v = listed[push.first + item];
    const HungVertex vertex = hung[v];
    const vec3 shift = restOf(v).xyz - vertex.rest.xyz;
    const uint held = heldWith(vertex.cell, vertex.corner);
    if (held == 255u && shift == vec3(0.0)) return;
    vec3 x = placeOf(vertex, held);
    if (shift != vec3(0.0)) x += TURN(vertex.anchor) * shift;
    vertices[vertex.vertex].position.xyz = x;
}
