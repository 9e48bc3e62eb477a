#version 460
// Runs before lists of edges are made: computes the midpoints of edges, and the speed of each edge's faster end in
// this substep or, as a way until the horizon, along its heading. Also stores the positions, bodies and headings of the
// ends: lists stay complete until ends have strayed from where these lead by more than the slack.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/math.glsl"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) readonly buffer Edges { ContactEdge edges[]; };
layout(std430, binding = 3) readonly buffer Thickness { float thickness[]; };
layout(std430, binding = 4) writeonly buffer Middles { vec4 middles[]; };
layout(std430, binding = 5) writeonly buffer Speeds { vec4 speeds[]; };    // x [m/s]
layout(std430, binding = 6) writeonly buffer Detected { vec4 detected[]; }; // one per particle
layout(std430, binding = 7) readonly buffer Bodies { float bodies[]; };     // one per particle
layout(std430, binding = 8) readonly buffer Watched { float watched[]; };   // one per particle; below 0 = nothing can touch its edges
layout(std430, binding = 9) readonly buffer Members { uint members[]; };    // particles that are ends
layout(std140, binding = 10) uniform Step { StepParams step; };
layout(std430, binding = 11) writeonly buffer Headings { vec4 headings[]; }; // one per particle
layout(std430, binding = 12) readonly buffer Frames { BodyFrame frames[FRAME_MOST_BODIES]; };
layout(std430, binding = 13) buffer Points { uint apart[]; }; // FACE_POINTS_...
layout(push_constant) uniform Push { ComputeEdgeBoundsPush push; };
#include "collision/body_frames.glsl"
#include "collision/headings.glsl"
#include "collision/count_motion.glsl"

vec3 headingOf(uint i) {
    const uint b = uint(clamp(bodies[i], 0.0, float(FRAME_MOST_BODIES - 1)));
    return headingOf(frames[b], positions[i].xyz, velocities[i].xyz, step.h, push.pace / step.h);
}

// Widening of the ball around a stretched edge; the search treats it as a motion of the ends. Edges removed by a cut
// have a radius below 0 and touch nothing.
float stretchOf(float len, uint e) { return edges[e].radius < 0.0 ? 0.0 : max(0.0, 0.5 * len + thickness[e] - edges[e].radius); }

void placeEdge(uint e) {
    const ContactEdge edge = edges[e];
    const vec3 a = positions[edge.a].xyz, b = positions[edge.b].xyz;
    const vec3 va = velocities[edge.a].xyz, vb = velocities[edge.b].xyz;
    const float fastest = max(max(length(va), length(vb)), push.ahead * max(length(headingOf(edge.a)), length(headingOf(edge.b))));
    middles[e] = vec4(0.5 * (a + b), 0.0);
    const float speed = fastest + stretchOf(distance(a, b), e) / step.h;
    speeds[e] = vec4(speed, 0.0, 0.0, 0.0);
    countMotion(e, edge.radius >= 0.0, step.h * speed, push.unit);
}

void main() {
    const uint item = itemIndex(push.items);
    if (item < push.edges) placeEdge(item);
    if (item >= push.members) return;
    const uint i = members[item];
    detected[i] = vec4(positions[i].xyz, watched[i] < 0.0 ? FRAME_NONE : bodies[i]);
    headings[i] = vec4(headingOf(i), 0.0);
}
