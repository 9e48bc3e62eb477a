#version 460
// Contacts with faces, third pass: the impulse of each, along n and against the way t that the two would slide on each other
// since they touched:
//
//   l = depth / D,   D = sum_k |beta_k| S_k w_k,   friction: t / D, at most static friction x l, else friction x l.
//
// What is remembered is the way that they really had slid when the substep began, less what is beyond the bound: the way that
// was predicted is longer by what friction took back, and summing it up would let a slope be crept up.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 1) readonly buffer Faces { ContactFace faces[]; };
layout(std430, binding = 2) readonly buffer Contacts { uvec2 contacts[]; };
layout(std430, binding = 3) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 4) readonly buffer Directions { vec4 directions[]; };
layout(std430, binding = 5) readonly buffer Weights { vec4 weights[]; };
layout(std430, binding = 6) readonly buffer Shares { float shares[]; };
layout(std430, binding = 7) buffer Memory { vec4 memory[]; };            // t [m], side and overlap
layout(std430, binding = 8) writeonly buffer Impulses { vec4 impulses[]; }; // [kg m]
layout(std430, binding = 9) readonly buffer Before { vec4 before[]; };      // velocities when the substep began
layout(std140, binding = 10) uniform Step { StepParams step; };
layout(std430, binding = 11) readonly buffer Surfaces { uint surfaces[]; }; // of each particle
layout(std430, binding = 12) readonly buffer Pairs { SurfacePair pairs[]; };
layout(push_constant) uniform Push { FacePush push; };

vec3 relative(vec4 point, vec4 a, vec4 b, vec4 c, vec4 weight) {
    return point.xyz - (weight.x * a.xyz + weight.y * b.xyz + weight.z * c.xyz);
}

// A face has the surface of its first corner.
SurfacePair pairOf(uint i, ContactFace face) { return pairs[surfaces[i] * push.surfaces + surfaces[face.a]]; }

void press(uint i, uint element) {
    const vec4 direction = directions[element], weight = weights[element];
    if (direction.w == 0.0) {
        memory[element] = vec4(vec3(0.0), weight.w); // an overlap that has yet to part
        return;
    }
    const ContactFace face = faces[contacts[element].x];
    const vec3 n = direction.xyz;
    const float D = shares[i] + weight.x * shares[face.a] + weight.y * shares[face.b] + weight.z * shares[face.c];
    const float share = D > 0.0 ? 1.0 / D : 0.0, lambda = share * abs(direction.w);
    vec3 slid = vec3(0.0); // until this substep
    if (memory[element].w != 0.0) slid = memory[element].xyz + step.h * relative(before[i], before[face.a], before[face.b], before[face.c], weight);
    vec3 slip = slid + step.h * relative(velocities[i], velocities[face.a], velocities[face.b], velocities[face.c], weight);
    slip -= dot(slip, n) * n;
    const SurfacePair pair = pairOf(i, face);
    const float force = length(slip) * share;
    const float held = force > pair.staticFriction * lambda ? pair.friction * lambda / force : 1.0;
    memory[element] = vec4(slid - (1.0 - held) * slip, weight.w);
    slip *= held;
    impulses[element] = vec4(lambda * n - share * slip, 0.0);
}

void main() {
    const uint i = itemIndex(push.count);
    const uvec2 list = lists[i];
    for (uint element = list.x; element < list.x + list.y; ++element) press(i, element);
}
