#version 460
// Opens the temporary constraints of a substep of `jacobi`: no plane touched yet, and the velocity an impact has.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 1) writeonly buffer Contacts { PlaneContact contacts[]; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const vec3 v = velocities[i].xyz;
    contacts[i] = PlaneContact(v.x, v.y, v.z, 0u);
}
