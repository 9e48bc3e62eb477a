// Checks for a particle whether lists are still complete, and whether contacts may lie on its path. Most particles
// never access the shared words. Requires VELOCITY, DETECTED, bounds, radii, fast, step, push of a kernel,
// FRAMES_BINDING, and WAYS_BINDING for two buffers.
#include "common/share_band.h"

// Two particles that may meet share a frame: what they move against it in a substep decides whether they do. The frame of
// particles that are not checked stands, and their ways are 0 (fall_asleep).
layout(constant_id = 14) const bool hasWays = false;
layout(std430, binding = WAYS_BINDING) writeonly buffer Ways { float ways[]; };          // see wayOf() [m]
layout(std430, binding = WAYS_BINDING + 1) readonly buffer Bodies { float bodies[]; }; // by slot, with a frame each
#define UNLISTED_BODY(i, r) (hasWays ? bodies[i] : 0.0)
#include "collision/strays.glsl"

// The part of the way of one of two particles by which they may come near each other [m]. In a substep the frame adds
// turn |r|, where r is what they are apart when lists were made. Two that are near each other at some time of the
// substep are no farther apart at its start than that distance, their ways, and what the frame adds; and r is no longer
// than that and their strays, over LEAST_STRETCH. Each of the two counts its part of the distance.
float wayOf(Stray stray, float radius) {
    const float own = length3(stray.way), more = stray.turn / (LEAST_STRETCH - stray.turn);
    return own + more * (own + stray.farthest + (1.0 + SHARE_BAND) * max(radius, 0.0) + 0.5 * push.margin);
}

void checkFast(uint i, float way) {
    if (radii[i] < 0.0) return; // in no list
    atomicMax(bounds.sweeping, 1u);
    if (!isInGrid(radii[i], push.most)) return;
    const uint sweeper = atomicAdd(bounds.sweepers, 1u);
    if (sweeper < MOST_SWEEPERS) fast[MOST_FAST + sweeper] = i;
    if (!isHurrying(radii[i], way, push.quiet, push.most)) return;
    const uint place = atomicAdd(bounds.hurrying, 1u);
    if (place < MOST_FAST) fast[place] = i;
}

void checkLists(uint i, vec3 x, vec3 v) {
    Stray stray;
    if (hasStrayed(i, x, v, stray)) atomicMax(bounds.moved, floatBitsToUint(clamp(stray.farthest, 1e-30, 1e30)));
    const float way = hasWays ? wayOf(stray, radii[i]) : wayOf(step.h, v); // see find_contacts and clamp_speeds
    if (hasWays) ways[i] = way;
    if (way > push.quiet) checkFast(i, way);
}
