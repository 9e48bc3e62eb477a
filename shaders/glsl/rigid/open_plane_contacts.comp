#version 460
// Opens the contacts of a substep of `jacobi`: no plane is touched yet, and the velocity of an impact is the present
// one.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 1) writeonly buffer Contacts { PlaneContact contacts[]; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const vec3 v = velocities[i].xyz;
    contacts[i] = PlaneContact(v.x, v.y, v.z, 0u);
}
