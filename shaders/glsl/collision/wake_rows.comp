#version 460
// Marks the islands of particles and faces, or of edges, that touch in this substep, if one of the four particles of a contact is
// awake and another is not.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "sleep/sleep.glsl"

layout(std430, binding = 0) readonly buffer Weights { float weights[]; }; // inverse mass of awake particles [1/kg]
layout(std430, binding = 1) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 2) readonly buffer Islands { uint islands[]; };
layout(std430, binding = 3) buffer Marks { uint marks[]; };
layout(std430, binding = 4) buffer State { SleepState state; };
layout(std430, binding = 5) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 6) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 7) readonly buffer Directions { vec4 directions[]; }; // w: depth [m]
layout(push_constant) uniform Push { SleepPush push; };
#define TOUCHING_BINDING 8
#include "collision/touching.glsl"

void main() {
    const uint i = itemIndex(push.count);
    for (uint k = firstList(i); k < lastList(i); ++k) {
        const uint owner = listOf(k);
        const uvec2 list = lists[owner];
        for (uint element = list.x; element < list.x + list.y; ++element) {
            if (!(directions[element].w > 0.0)) continue;
            const uint all[4] = touchingOf(owner, contacts[element].other);
            bool isTouched = false;
            for (uint m = 0u; m < 4u; ++m) isTouched = isTouched || velocities[all[m]].w > 0.0;
            for (uint m = 0u; m < 4u; ++m) {
                if (!isTouched || !isAsleep(weights[all[m]], velocities[all[m]])) continue;
                atomicOr(marks[islands[all[m]]], 1u);
                atomicOr(state.touched, 1u);
            }
        }
    }
}
