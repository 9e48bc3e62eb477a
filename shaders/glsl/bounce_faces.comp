#version 460
// Restitution of contacts with faces, first pass: which of them rebound, and at what speed the two must part, by Newton's law
// against the velocities before the substep. Impacts slower than step.restSpeed do not, or resting contacts would tremble.
// share_faces then says what particles give of themselves to those alone, rebound_faces the impulses.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Before { vec4 before[]; };     // velocities when the substep began [m/s]
layout(std430, binding = 1) readonly buffer Faces { ContactFace faces[]; };
layout(std430, binding = 2) readonly buffer Contacts { uvec2 contacts[]; };
layout(std430, binding = 3) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 4) readonly buffer Directions { vec4 directions[]; };
layout(std430, binding = 5) readonly buffer Weights { vec4 weights[]; };
layout(std430, binding = 6) readonly buffer Surfaces { uint surfaces[]; }; // of each particle
layout(std430, binding = 7) readonly buffer Pairs { SurfacePair pairs[]; };
layout(std140, binding = 8) uniform Step { StepParams step; };
layout(std430, binding = 9) writeonly buffer Bounces { vec4 bounces[]; };  // n, speed [m/s]; 0 = does not rebound
layout(push_constant) uniform Push { FacePush push; };

float speedOf(uint i, uint element) {
    const ContactFace face = faces[contacts[element].x];
    const vec3 b = weights[element].xyz;
    const vec3 v = before[i].xyz - (b.x * before[face.a].xyz + b.y * before[face.b].xyz + b.z * before[face.c].xyz);
    const float speed = dot(directions[element].xyz, v);
    return speed < -step.restSpeed ? -pairs[surfaces[i] * push.surfaces + surfaces[face.a]].restitution * speed : 0.0;
}

void main() {
    const uint i = itemIndex(push.count);
    const uvec2 list = lists[i];
    for (uint element = list.x; element < list.x + list.y; ++element) {
        const vec4 direction = directions[element];
        bounces[element] = vec4(direction.xyz, direction.w > 0.0 ? speedOf(i, element) : 0.0);
    }
}
