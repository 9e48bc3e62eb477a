#version 460
// Lists the work groups in which an edge has a candidate, and those of ends of such edges. No pass looks at an edge without candidates, but its
// ends sum up what it does to them: nothing.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 1) readonly buffer Edges { ContactEdge edges[]; };
layout(std430, binding = 2) writeonly buffer Sums { float sums[]; };
layout(std430, binding = 3) writeonly buffer Impulses { vec4 impulses[]; };
layout(std430, binding = 4) buffer Bounds { GridBounds bounds; };
#define GROUPS_BINDING 5
#define LISTS_OWNERS
#define LISTS_PARTICLES
#include "listed_groups.glsl"
layout(push_constant) uniform Push { FaceFindPush push; };

void main() {
    const uint e = itemIndex(push.points);
    if (lists[e].y > 0u) {
        listOwner(e);
        listParticle(edges[e].a);
        listParticle(edges[e].b);
    } else {
        sums[2u * e] = sums[2u * e + 1u] = 0.0;
        impulses[2u * e] = impulses[2u * e + 1u] = vec4(0.0);
    }
}
