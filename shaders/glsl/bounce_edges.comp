#version 460
// Restitution of contacts between edges, first pass, as in bounce_faces; and the sums that share_edges takes.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "edges.glsl" // velocities: when the substep began
layout(std430, binding = 4) readonly buffer Directions { vec4 directions[]; };
layout(std430, binding = 5) readonly buffer Weights { vec4 weights[]; };
layout(std430, binding = 6) readonly buffer Surfaces { uint surfaces[]; }; // of each particle
layout(std430, binding = 7) readonly buffer Pairs { SurfacePair pairs[]; };
layout(std140, binding = 8) uniform Step { StepParams step; };
layout(std430, binding = 9) writeonly buffer Bounces { vec4 bounces[]; };  // n of the first edge, speed [m/s]
layout(std430, binding = 10) writeonly buffer Sums { float sums[]; };      // of the weights of each end

vec4 bounceOf(EdgePair pair, vec3 n, vec2 st) {
    const uint a = pair.first.a, c = pair.second.a;
    const vec3 v = between(velocities[a].xyz, velocities[pair.first.b].xyz, velocities[c].xyz, velocities[pair.second.b].xyz, st);
    const float speed = dot(n, v);
    return vec4(n, speed < -step.restSpeed ? -pairs[surfaces[a] * push.surfaces + surfaces[c]].restitution * speed : 0.0);
}

void main() {
    const uint e = itemIndex(push.count);
    const uvec2 list = lists[e];
    vec2 sum = vec2(0.0);
    for (uint element = list.x; element < list.x + list.y; ++element) {
        const vec4 direction = directions[element];
        const vec2 own = weights[element].xy;
        vec4 bounce = vec4(0.0);
        if (direction.w > 0.0) {
            const EdgePair pair = pairOf(e, contacts[element].x);
            bounce = bounceOf(pair, pair.isFirst ? direction.xyz : -direction.xyz, pair.isFirst ? own : own.yx);
        }
        bounces[element] = bounce;
        if (bounce.w > 0.0) sum += vec2(1.0 - own.x, own.x);
    }
    sums[2u * e] = sum.x;
    sums[2u * e + 1u] = sum.y;
}
