#version 460
// Where the listed vertices of a skin are in the state that the step begins with, once for all prisms around each.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "cut.glsl"
#include "link_masks.glsl"
#include "kuhn.glsl"

layout(std430, binding = 0) readonly buffer SavedLinks { uint savedLinks[]; };
layout(std430, binding = 1) readonly buffer Places { vec4 places[]; };
layout(std430, binding = 2) readonly buffer Rest { vec4 rest[]; };
layout(std430, binding = 3) readonly buffer Hung { HungVertex hung[]; };
layout(std430, binding = 4) readonly buffer Partitions { uint partitions[]; }; // before this step
layout(std430, binding = 5) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 6) readonly buffer Listed { uint listed[]; };
layout(std430, binding = 7) writeonly buffer Placed { vec4 placed[]; };

#include "before_cut.glsl"

// Cells that were whole hang together.
vec3 placeNow(HungVertex vertex) {
    uint held = 255u;
    if (partitions[vertex.cell] != 0u) held = heldWith(vertex.cell, vertex.corner);
    return placeOf(vertex, held);
}

void main() {
    const uint count = counts[SKIN_LISTS * push.run + SKIN_VERTICES], item = itemIndex(count);
    if (item >= count) return;
    const uint v = listed[push.first + item];
    placed[v] = vec4(placeNow(hung[v]), 1.0);
}
