#version 460
// Takes the particles of absent bodies out of a grid of contacts, and lets those of others in. Lists are made again.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(constant_id = 1) const bool hasRadii = true;     // the grid is one of particles
layout(constant_id = 2) const bool hasTouching = false; // their faces touch what has another radius
layout(constant_id = 3) const bool hasWatched = false;  // not only what is in the grid is checked
layout(std430, binding = 0) readonly buffer Particles { PoolParticle particles[]; };
layout(std430, binding = 1) readonly buffer Changes { uint changes[]; };
layout(std430, binding = 2) buffer Detected { vec4 detected[]; }; // by slot: position when lists were made
layout(std430, binding = 3) buffer Bounds { GridBounds bounds; };
layout(std430, binding = 4) readonly buffer InitialRadii { float initialRadii[]; };
layout(std430, binding = 5) writeonly buffer Radii { float radii[]; }; // by slot; below 0 = not in the grid
layout(std430, binding = 6) readonly buffer InitialTouching { float initialTouching[]; };
layout(std430, binding = 7) writeonly buffer Touching { float touching[]; }; // by slot; below 0 = touches nothing
layout(std430, binding = 8) readonly buffer InitialWatched { float initialWatched[]; };
layout(std430, binding = 9) writeonly buffer Watched { float watched[]; }; // by slot; below 0 = not checked
layout(constant_id = 4) const bool hasDebris = false; // fragments may have been removed
layout(std430, binding = 10) readonly buffer Pieces { uint pieces[]; };
layout(push_constant) uniform Push { PoolPush push; };
#include "common/pieces.h"

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const PoolParticle one = particles[item];
    const uint change = changes[one.body], i = one.slot;
    if (change == POOL_SAME) return;
    // a body that returns has the fragments that were removed from it
    const bool isGone = change == POOL_GONE || change == POOL_LEFT ||
                        hasDebris && change == POOL_RETURNED && pieces[one.particle] == REMOVED_PIECE;
    if (hasRadii) radii[i] = isGone ? -1.0 : initialRadii[i];
    if (hasTouching) touching[i] = isGone ? -1.0 : initialTouching[i];
    if (hasWatched) watched[i] = isGone ? -1.0 : initialWatched[i];
    detected[i].xyz = vec3(1e18);
    if (bounds.moved == 0u) atomicMax(bounds.moved, 1u);
}
