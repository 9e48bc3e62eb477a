// The particles that a motion acts on. Requires the names positions, velocities and step of a kernel, and
// MEMBERS_BINDING: the first of four bindings. Bits do not depend on the kernel.
#include "common/math.glsl"
#include "common/pieces.h"
#include "common/remainder.glsl"
#include "sleep/sleep.glsl"

layout(constant_id = 1) const bool maySleep = false;
layout(constant_id = 2) const bool hasDebris = false; // fragments may have been removed
layout(std430, binding = MEMBERS_BINDING) readonly buffer Bodies { uint bodies[]; };         // by slot: index into Scene::bodies
layout(std430, binding = MEMBERS_BINDING + 1) readonly buffer Weights { float weights[]; };  // inverse mass, also of sleeping particles [1/kg]
layout(std430, binding = MEMBERS_BINDING + 2) readonly buffer Particles { uint particles[]; }; // by slot
layout(std430, binding = MEMBERS_BINDING + 3) readonly buffer Pieces { uint pieces[]; };

// Inverse mass [1/kg]; 0 = never moves, or is a removed fragment.
float inverseMassOf(uint i) {
    const float w = maySleep ? max(weights[i], 0.0) : velocities[i].w;
    if (!hasDebris || particles[i] == NO_PARTICLE) return w;
    return pieces[particles[i]] == REMOVED_PIECE ? 0.0 : w;
}

// Position at the start of the step.
vec3 placeOf(uint i) {
    vec3 x = positions[i].xyz;
    if (hasRemainders) x += positions[remainderOf(positions.length(), i)].xyz;
    return x - step.thetaHPrevious * velocities[i].xyz;
}

bool actsOn(MotionRequest request, uint body, vec3 x) {
    if (request.body != MOTION_ALL_BODIES && request.body != body) return false;
    const float radius = request.linear.w;
    const vec3 d = x - request.center.xyz;
    return radius == 0.0 || dot3(d, d) < radius * radius;
}

bool isOfRound(MotionRequest request, uint isPose) {
    return request.kind != MOTION_NONE && (request.kind >= MOTION_POSE) == (isPose != 0u);
}
