#version 460
// Takes the edges of absent bodies out of the grid of edges, and lets those of others in.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Edges { ContactEdge edges[]; };
layout(std430, binding = 1) readonly buffer Bodies { uint bodies[]; }; // by slot
layout(std430, binding = 2) readonly buffer Changes { uint changes[]; };
layout(std430, binding = 3) readonly buffer InitialRadii { float initialRadii[]; };
layout(std430, binding = 4) writeonly buffer Radii { float radii[]; }; // by edge; below 0 = not in the grid
layout(push_constant) uniform Push { PoolPush push; };

void mask(uint e) {
    const uint body = bodies[edges[e].a];
    if (body >= push.all || changes[body] == POOL_SAME) return;
    radii[e] = changes[body] == POOL_GONE || changes[body] == POOL_LEFT ? -1.0 : initialRadii[e];
}

void main() {
    for (uint e = gl_GlobalInvocationID.x; e < push.count; e += POOL_EDGE_GROUPS * GROUP_SIZE) mask(e);
}
