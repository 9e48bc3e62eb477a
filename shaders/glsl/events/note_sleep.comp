#version 460
// Notes at the end of a step which bodies have particles that are awake, which have some that sleep, and which are absent.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "events/events.h"
#include "sleep/sleep.glsl"
#include "events/absent.glsl"

layout(std430, binding = 0) readonly buffer Bodies { uint bodies[]; };    // by slot
layout(std430, binding = 1) readonly buffer Weights { float weights[]; }; // inverse mass of awake particles [1/kg]
layout(std430, binding = 2) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 3) buffer Noted { BodyEvents noted[]; };
layout(std430, binding = 4) readonly buffer Positions { vec4 positions[]; };
layout(push_constant) uniform Push { EventPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const uint body = bodies[i];
    if (body == NO_BODY) return;
    const vec4 velocity = velocities[i];
    if (velocity.w == 0.0 && noted[body].awake == 0u && isAbsent(positions[i].xyz)) atomicOr(noted[body].awake, EVENT_ABSENT);
    if (velocity.w > 0.0 && noted[body].awake == 0u) atomicOr(noted[body].awake, 1u);
    if (isAsleep(weights[i], velocity) && noted[body].asleep == 0u) atomicOr(noted[body].asleep, 1u);
}
