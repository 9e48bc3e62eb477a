#version 460
// Measures the surfaces that wind presses on: each corner of a triangle stands for a third of its area vector, which
// points outwards. Runs once a step, if there is wind.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Corners { FieldCorner corners[]; };
layout(std430, binding = 1) readonly buffer Positions { vec4 positions[]; }; // public [m]
layout(std430, binding = 2) writeonly buffer Areas { vec4 areas[]; };        // by corner [m^2]
layout(push_constant) uniform Push { FieldPush push; };

void main() {
    const uint k = itemIndex(push.count);
    if (k >= push.count) return;
    const FieldCorner corner = corners[k];
    const vec3 a = positions[corner.particles[0]].xyz, b = positions[corner.particles[1]].xyz,
               c = positions[corner.particles[2]].xyz;
    const vec3 ab = b - a, ac = c - a, bc = c - b;
    const float longest = max(max(dot(ab, ab), dot(ac, ac)), dot(bc, bc));
    areas[k] = vec4(longest <= corner.farthest ? cross(ab, ac) / 6.0 : vec3(0.0), 0.0);
}
