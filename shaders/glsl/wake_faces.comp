#version 460
// Marks the islands of particles and faces that touch in this substep, where one of the four particles of a contact is awake
// and another is not.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"
#include "sleep.glsl"

layout(std430, binding = 0) readonly buffer Weights { float weights[]; }; // inverse mass of what is awake [1/kg]
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) readonly buffer Islands { uint islands[]; };
layout(std430, binding = 3) buffer Marks { uint marks[]; };
layout(std430, binding = 4) buffer State { SleepState state; };
layout(std430, binding = 5) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 6) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 7) readonly buffer Directions { vec4 directions[]; }; // w: depth [m]
layout(std430, binding = 8) readonly buffer Faces { ContactFace faces[]; };
layout(push_constant) uniform Push { SleepPush push; };

void main() {
    const uint i = itemIndex(push.count);
    for (uint s = 0u; s < counts[i]; ++s) {
        const uint element = s * push.faceRow + i;
        if (!(directions[element].w > 0.0)) continue;
        const ContactFace face = faces[contacts[element].other];
        const uint all[4] = uint[](i, face.a, face.b, face.c);
        bool isTouched = false;
        for (uint k = 0u; k < 4u; ++k) isTouched = isTouched || velocities[all[k]].w > 0.0;
        for (uint k = 0u; k < 4u; ++k) {
            if (!isTouched || !isAsleep(weights[all[k]], velocities[all[k]])) continue;
            atomicOr(marks[islands[all[k]]], 1u);
            atomicOr(state.touched, 1u);
        }
    }
}
