#version 460
// Restitution of contacts with faces, third pass: the impulse that lets two part at the speed that they must,
//
//   l = (speed - n . v) / D >= 0,   D = sum_k |beta_k| S_k w_k over contacts that rebound (face_contacts.hpp).
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Velocities { vec4 velocities[]; }; // after all contacts of the substep
layout(std430, binding = 1) readonly buffer Faces { ContactFace faces[]; };
layout(std430, binding = 2) readonly buffer Contacts { uvec2 contacts[]; };
layout(std430, binding = 3) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 4) readonly buffer Bounces { vec4 bounces[]; };
layout(std430, binding = 5) readonly buffer Weights { vec4 weights[]; };
layout(std430, binding = 6) readonly buffer Shares { float shares[]; };
layout(std430, binding = 7) writeonly buffer Impulses { vec4 impulses[]; };    // [kg m/s]
layout(push_constant) uniform Push { FacePush push; };

vec3 impulseOf(uint i, uint element) {
    const ContactFace face = faces[contacts[element].x];
    const vec4 bounce = bounces[element];
    const vec3 b = weights[element].xyz;
    const vec3 v = velocities[i].xyz - (b.x * velocities[face.a].xyz + b.y * velocities[face.b].xyz + b.z * velocities[face.c].xyz);
    const float D = shares[i] + b.x * shares[face.a] + b.y * shares[face.b] + b.z * shares[face.c];
    return D > 0.0 ? max(0.0, bounce.w - dot(bounce.xyz, v)) / D * bounce.xyz : vec3(0.0);
}

void main() {
    const uint i = itemIndex(push.count);
    const uvec2 list = lists[i];
    for (uint element = list.x; element < list.x + list.y; ++element) {
        if (bounces[element].w > 0.0) impulses[element] = vec4(impulseOf(i, element), 0.0);
    }
}
