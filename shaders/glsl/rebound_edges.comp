#version 460
// Restitution of contacts between edges, third pass, as in rebound_faces: what both ends of an edge get of all of its own.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "edges.glsl" // velocities: after all contacts of the substep
layout(std430, binding = 4) readonly buffer Bounces { vec4 bounces[]; }; // n of the first edge, speed [m/s]
layout(std430, binding = 5) readonly buffer Weights { vec4 weights[]; };
layout(std430, binding = 6) readonly buffer Shares { float shares[]; };
layout(std430, binding = 7) writeonly buffer Impulses { vec4 impulses[]; }; // on each end [kg m/s]

vec3 impulseOf(EdgePair pair, vec4 bounce, vec2 st) {
    const uint a = pair.first.a, b = pair.first.b, c = pair.second.a, d = pair.second.b;
    const float D = mix(shares[a], shares[b], st.x) + mix(shares[c], shares[d], st.y);
    const vec3 v = between(velocities[a].xyz, velocities[b].xyz, velocities[c].xyz, velocities[d].xyz, st);
    return D > 0.0 ? max(0.0, bounce.w - dot(bounce.xyz, v)) / D * bounce.xyz : vec3(0.0);
}

void main() {
    const uint e = itemIndex(push.count);
    const uvec2 list = lists[e];
    vec3 onA = vec3(0.0), onB = vec3(0.0);
    for (uint element = list.x; element < list.x + list.y; ++element) {
        const vec4 bounce = bounces[element];
        if (!(bounce.w > 0.0)) continue;
        const EdgePair pair = pairOf(e, contacts[element].x);
        const vec2 own = weights[element].xy;
        const vec3 impulse = impulseOf(pair, bounce, pair.isFirst ? own : own.yx);
        onA += (1.0 - own.x) * (pair.isFirst ? impulse : -impulse);
        onB += own.x * (pair.isFirst ? impulse : -impulse);
    }
    impulses[2u * e] = vec4(onA, 0.0);
    impulses[2u * e + 1u] = vec4(onB, 0.0);
}
