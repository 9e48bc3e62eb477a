#version 460
// Counts the pieces of each body after they were found again (count_pieces.comp).
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "events/events.h"

layout(std430, binding = 0) readonly buffer Bodies { uint bodies[]; }; // by slot
layout(std430, binding = 1) readonly buffer Particles { uint particles[]; };
layout(std430, binding = 2) readonly buffer Sizes { uint sizes[]; }; // by particle: of the piece that it names
layout(std430, binding = 3) buffer Pieces { uint pieces[]; };        // by body
layout(push_constant) uniform Push { EventCutPush push; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item, particle = particles[i];
    if (particle != NO_PARTICLE && bodies[i] != NO_BODY && sizes[particle] > 0u) atomicAdd(pieces[bodies[i]], 1u);
}
