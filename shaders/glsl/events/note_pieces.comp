#version 460
// Counts the pieces of each body after they were found again (count_pieces.comp), and its removed fragments
// (remove_debris.comp).
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "events/events.h"

layout(std430, binding = 0) readonly buffer Bodies { uint bodies[]; }; // by slot
layout(std430, binding = 1) readonly buffer Particles { uint particles[]; };
layout(std430, binding = 2) readonly buffer Sizes { uint sizes[]; }; // by particle: of the piece that it names
layout(std430, binding = 3) buffer Counts { uint counts[]; }; // pieces by body, then removed fragments by body
layout(std430, binding = 4) readonly buffer Pieces { uint pieces[]; }; // by particle
layout(std430, binding = 5) readonly buffer Labels { uint labels[]; };
layout(push_constant) uniform Push { EventCutPush push; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item, particle = particles[i];
    if (particle == NO_PARTICLE || bodies[i] == NO_BODY) return;
    if (sizes[particle] > 0u) atomicAdd(counts[bodies[i]], 1u);
    else if (pieces[particle] == REMOVED_PIECE && labels[i] == i) atomicAdd(counts[push.bodies + bodies[i]], 1u);
}
