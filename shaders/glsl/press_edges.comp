#version 460
// Contacts between edges, third pass: the impulse of each, as in press_faces, and what the two ends of an edge get of all of
// its own. Both edges of a contact compute the same bits.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "edges.glsl"
layout(std430, binding = 4) readonly buffer Directions { vec4 directions[]; };
layout(std430, binding = 5) readonly buffer Weights { vec4 weights[]; };
layout(std430, binding = 6) readonly buffer Shares { float shares[]; };
layout(std430, binding = 7) buffer Memory { vec4 memory[]; };               // t of the first edge [m], side and overlap
layout(std430, binding = 8) writeonly buffer Impulses { vec4 impulses[]; }; // on each end [kg m]
layout(std430, binding = 9) readonly buffer Before { vec4 before[]; };      // velocities when the substep began
layout(std140, binding = 10) uniform Step { StepParams step; };
layout(std430, binding = 11) readonly buffer Surfaces { uint surfaces[]; }; // of each particle
layout(std430, binding = 12) readonly buffer Pairs { SurfacePair pairs[]; };

// On the first of the two.
vec3 impulseOf(EdgePair pair, vec3 n, float depth, vec2 st, float remembered, uint element) {
    const uint a = pair.first.a, b = pair.first.b, c = pair.second.a, d = pair.second.b;
    const float D = mix(shares[a], shares[b], st.x) + mix(shares[c], shares[d], st.y);
    const float share = D > 0.0 ? 1.0 / D : 0.0, lambda = share * depth;
    vec3 slid = vec3(0.0); // until this substep
    if (memory[element].w != 0.0) slid = memory[element].xyz + step.h * between(before[a].xyz, before[b].xyz, before[c].xyz, before[d].xyz, st);
    vec3 slip = slid + step.h * between(velocities[a].xyz, velocities[b].xyz, velocities[c].xyz, velocities[d].xyz, st);
    slip -= dot(slip, n) * n;
    const SurfacePair surface = pairs[surfaces[a] * push.surfaces + surfaces[c]];
    const float force = length(slip) * share;
    const float held = force > surface.staticFriction * lambda ? surface.friction * lambda / force : 1.0;
    memory[element] = vec4(slid - (1.0 - held) * slip, remembered);
    return lambda * n - share * held * slip;
}

void main() {
    const uint e = itemIndex(push.count);
    const uvec2 list = lists[e];
    vec3 onA = vec3(0.0), onB = vec3(0.0);
    for (uint element = list.x; element < list.x + list.y; ++element) {
        const vec4 direction = directions[element], weight = weights[element];
        if (!(direction.w > 0.0)) {
            memory[element] = vec4(vec3(0.0), weight.w);
            continue;
        }
        const EdgePair pair = pairOf(e, contacts[element].x);
        const vec3 along = pair.isFirst ? direction.xyz : -direction.xyz;
        const vec2 st = pair.isFirst ? weight.xy : weight.yx;
        const vec3 impulse = impulseOf(pair, along, direction.w, st, weight.w, element);
        const vec3 own = pair.isFirst ? impulse : -impulse;
        onA += (1.0 - weight.x) * own;
        onB += weight.x * own;
    }
    impulses[2u * e] = vec4(onA, 0.0);
    impulses[2u * e + 1u] = vec4(onB, 0.0);
}
