#version 460
// Impact zones, solution: each zone with a new pair moves on like one rigid body that does not turn, from the time at
// which its first pair is as near as it may come. Its members end with the displacement that their centre of mass has
// left, and with its velocity: momentum stays, and nothing passes in the zone. A member that never gives way carries its
// zone along. Sums are in integers, so that they have no order. One work group.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "common/remainder.glsl"

layout(std430, binding = 0) readonly buffer Predicted { vec4 predicted[]; };
layout(std430, binding = 1) readonly buffer PredictedVelocities { vec4 predictedVelocities[]; }; // that led to those positions [m/s]
layout(std430, binding = 2) buffer Positions { vec4 positions[]; };   // x + thetaH v (remainder.glsl)
layout(std430, binding = 3) buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std140, binding = 4) uniform Step { StepParams step; };
layout(std430, binding = 5) coherent volatile buffer Words { uint words[]; };
layout(std430, binding = 6) readonly buffer Pairs { ZonePair pairs[]; };
layout(std430, binding = 7) coherent buffer Zones { Zone zones[]; };
layout(std430, binding = 8) buffer Finding { DispatchArguments finding[]; };
layout(push_constant) uniform Push { ZonePush push; };
#include "forces/forces.glsl"
#define FOR_EACH(item, end) for (uint item = gl_LocalInvocationID.x; item < (end); item += GROUP_SIZE)
#include "collision/zone_trees.glsl"
#include "collision/zone_sums.glsl"

const uint zoneMark = 0x80000000u; // of a root whose word holds the number of its zone
shared uint zoneCount;

void synchronize() {
    memoryBarrierBuffer();
    barrier();
}

// After numberZones().
uint zoneOf(uint i) {
    const uint parent = PARENT(i);
    return (parent & zoneMark) != 0u ? parent & ~zoneMark : PARENT(parent - 1u) & ~zoneMark;
}

void numberZones(uint count) {
    if (gl_LocalInvocationID.x == 0u) zoneCount = 0u;
    FOR_EACH(m, count) PARENT(MEMBER(m)) = rootOf(MEMBER(m)) + 1u;
    synchronize();
    FOR_EACH(m, count) {
        const uint i = MEMBER(m);
        if (PARENT(i) != i + 1u) continue;
        const uint zone = atomicAdd(zoneCount, 1u);
        clearZone(zone);
        PARENT(i) = zoneMark | zone;
    }
    synchronize();
}

void sumZones(uint count, uint pairCount) {
    FOR_EACH(m, count) measureMember(zoneOf(MEMBER(m)), MEMBER(m));
    FOR_EACH(p, min(pairCount, ZONE_PAIRS)) atomicMax(zones[zoneOf(pairs[p].point)].early, ~floatBitsToUint(pairs[p].time));
    if (pairCount > ZONE_PAIRS) // some have no time of their own
        FOR_EACH(m, count) atomicMax(zones[zoneOf(MEMBER(m))].early, ~0u);
    synchronize();
    const int bits = bitsFor(count);
    FOR_EACH(m, count) addMember(zoneOf(MEMBER(m)), MEMBER(m), bits);
    synchronize();
}

void moveMember(uint i, Common motion, float time) {
    const vec4 velocity = velocities[i];
    const vec3 way = (1.0 - time) * (motion.way - wayOf(i)), faster = motion.velocity - velocity.xyz;
    const vec3 change = way + step.thetaH * faster;
    addContactForce(i, faster / velocity.w);
    velocities[i].xyz = motion.velocity;
    if (hasRemainders) {
        const uint r = remainderOf(positions.length(), i);
        const Sum sum = exactSum(positions[i].xyz, change + positions[r].xyz);
        positions[i].xyz = sum.rounded;
        positions[r].xyz = sum.remainder;
    } else {
        positions[i].xyz += change;
    }
}

// `keepsTimes`: else zones move as one from the start of the substep.
void moveZones(uint count, bool keepsTimes) {
    const int bits = bitsFor(count);
    FOR_EACH(m, count) {
        const uint i = MEMBER(m), zone = zoneOf(i), early = zones[zone].early;
        if (early == 0u) continue;
        const Common motion = commonOf(zone, bits);
        if (velocities[i].w > 0.0) moveMember(i, motion, keepsTimes ? uintBitsToFloat(~early) : 0.0);
        else if (zones[zone].driven == ~i) addContactForce(i, motion.impulse);
    }
    synchronize();
}

// Leaves the trees to the next search, or clears them.
void close(uint count, bool isDone) {
    FOR_EACH(m, count) {
        const uint i = MEMBER(m), parent = PARENT(i), root = (parent & zoneMark) != 0u ? i + 1u : parent;
        PARENT(i) = isDone ? 0u : root;
        SOLVED(i) = isDone ? 0u : root;
    }
    if (gl_LocalInvocationID.x > 0u) return;
    for (uint kind = 0u; kind < 2u; ++kind) { // points, edges
        const uint search = kind * ZONE_OF_EDGES + push.round;
        finding[search].groupsX = 0u;
        if (push.round + 1u < ZONE_ROUNDS) finding[search + 1u].groupsX = isDone ? 0u : finding[ZONE_GROUPS + kind].groupsX;
    }
    words[ZONE_PAIR_COUNT] = 0u;
    if (isDone) words[ZONE_MEMBER_COUNT] = 0u;
}

void main() {
    const uint count = words[ZONE_MEMBER_COUNT], pairCount = words[ZONE_PAIR_COUNT];
    synchronize();
    if (pairCount > 0u) {
        numberZones(count);
        sumZones(count, pairCount);
        moveZones(count, pairCount <= ZONE_PAIRS);
    }
    close(count, pairCount == 0u || push.round + 1u == ZONE_ROUNDS);
}
