#version 460
// Where the middles of edges are, and how fast the faster end of each. Finds out whether an end is, or was when the substep
// began, farther from where it was when lists were made than they bear. plan_grid decides what follows.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) readonly buffer Edges { ContactEdge edges[]; };
layout(std430, binding = 3) readonly buffer Ends { vec4 ends[]; };         // two of each edge, when lists were made
layout(std430, binding = 4) readonly buffer Detected { vec4 detected[]; }; // middles then; far away after an undone step
layout(std430, binding = 5) writeonly buffer Middles { vec4 middles[]; };
layout(std430, binding = 6) writeonly buffer Speeds { vec4 speeds[]; };    // x [m/s]
layout(std430, binding = 7) buffer Bounds { GridBounds bounds; };
layout(std140, binding = 8) uniform Step { StepParams step; };
layout(push_constant) uniform Push { GridPush push; };

float movedOf(vec3 x, vec3 v, vec3 before) {
    const vec3 way = x - before, first = way - step.h * v;
    return max(dot(way, way), dot(first, first));
}

void main() {
    const uint e = itemIndex(push.count);
    const ContactEdge edge = edges[e];
    const vec3 a = positions[edge.a].xyz, b = positions[edge.b].xyz;
    const vec3 va = velocities[edge.a].xyz, vb = velocities[edge.b].xyz, middle = 0.5 * (a + b);
    middles[e] = vec4(middle, 0.0);
    speeds[e] = vec4(sqrt(max(dot(va, va), dot(vb, vb))), 0.0, 0.0, 0.0);
    if (edge.radius < 0.0) return;
    const vec3 left = middle - detected[e].xyz;
    const float squared = max(dot(left, left), max(movedOf(a, va, ends[2u * e].xyz), movedOf(b, vb, ends[2u * e + 1u].xyz)));
    const float slack = push.isLater == 0u && (step.lists & LISTS_REPEATS) != 0u ? LISTS_EARLY * push.slack : push.slack;
    if (!(squared <= slack * slack)) // what is no number has gone far
        atomicMax(bounds.moved, floatBitsToUint(min(sqrt(squared), 1e30)));
}
