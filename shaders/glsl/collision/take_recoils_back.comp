#version 460
// Recoils, second pass: solves for impulses f x most, -1 <= f <= 0, after which no contact parts that could take more
// back (sim/collision/recoils.hpp). One work group. Projected Jacobi iterations with Nesterov's momentum: with D the sum
// over both ends of contacts x inverse mass,
//   f' = clamp(g - n . (v_i - v_j) / (most D), -1, 0),   g' = f' + k / (k + 3) (f' - f),   v_i = v_i0 + w_i sum most g' n
//
// They begin at particles that part fast, and spread to partners of what has changed. Factors are whole numbers of
// RECOIL_UNIT: what recoils do not reach keeps its bits, and iterations end when nothing changes.
#extension GL_GOOGLE_include_directive : require
#define GROUP_SIZE 8 // few take part, and a software device pays for each invocation at a barrier
#include "common/kernel.glsl"
#include "common/contacts.glsl"
#include "common/remainder.glsl"
#include "common/fetched.glsl"
FETCHED_VEC4(0, Touching, touchingAt)
layout(std430, binding = 1) buffer State { vec4 state[]; };           // x + thetaH v (remainder.glsl); w: see areFreeOf()
layout(std430, binding = 2) buffer Velocities { vec4 velocities[]; }; // w = inverse mass [1/kg]
layout(std430, binding = 3) coherent buffer Even { vec4 even[]; };    // v of an iteration; w: share, below 0 = not reached
layout(std430, binding = 4) coherent buffer Odd { vec4 odd[]; };
layout(std140, binding = 5) uniform Step { StepParams step; };
layout(std430, binding = 6) coherent buffer Recoils { Recoil recoils[]; };   // RECOIL_CONTACTS a slot
layout(std430, binding = 7) coherent buffer Members { uint members[]; };     // those that part fast; then all that take part
layout(std430, binding = 8) coherent buffer Degrees { uint degrees[]; };     // contacts of these, with RECOIL_LISTED; else 0
layout(std430, binding = 9) readonly buffer Arguments { DispatchArguments arguments[]; };
#include "forces/received_sections.glsl"
FETCHED_UVEC4(10, Received, receivedBits)
vec4 receivedAt(uint element) { return uintBitsToFloat(receivedBits(element)); }
FETCHED_UVEC2(11, Contacts, contactAt)
layout(std430, binding = 12) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 13) readonly buffer Near { uvec2 near[]; };
layout(constant_id = 4) const bool hasRecovery = false;
layout(std430, binding = 14) readonly buffer Slips { vec4 slips[]; }; // w: remaining overlap, below 0 = keeps its rest distance
FETCHED_VEC4(15, Linked, linkedAt)                                    // velocities before contacts
layout(push_constant) uniform Push { RecoilPush push; };
#include "forces/forces.glsl"
#include "forces/recoil_speed.glsl"
#define FOR_EACH(item, from, end) for (uint item = (from) + gl_LocalInvocationID.x; item < (end); item += GROUP_SIZE)
shared uint changes[2], reached;
#include "collision/recoil_contacts.glsl"

void synchronize() {
    memoryBarrierBuffer();
    barrier();
}

uint memberAt(uint m) { return members[push.count + m]; }

// One iteration of particle i, which takes its velocity from one buffer to the other; isOdd is known where it is called.
void iterate(uint i, uint round, bool isOdd) {
    const vec4 own = isOdd ? odd[i] : even[i], velocity = velocities[i];
    const float momentum = float(round) / float(round + 3u);
    vec3 sum = vec3(0.0);
    bool hasChanged = false;
    for (uint c = 0u; c < degreeOf(i); ++c) {
        const uint at = RECOIL_CONTACTS * i + c;
        const Recoil recoil = recoils[at];
        const bool isStill = (recoil.other & RECOIL_STILL) != 0u;
        const uint j = isStill ? i : recoil.other;
        const vec4 other = isStill ? vec4(0.0) : isOdd ? odd[j] : even[j];
        if (own.w < 0.0 && (other.w <= 0.0 || degreeOf(j) == 0u)) continue; // nobody has reached the two
        const vec3 n = normalOf(recoil);
        const float speed = dot3(n, own.xyz - other.xyz) - recoil.drift; // at which they part [m/s]
        const int before = int(recoil.taken);
        const float way = speed / (recoil.most * (abs(own.w) + abs(other.w)) * RECOIL_UNIT);
        const float f = floor(clamp(second(before) - way, -1.0 / RECOIL_UNIT, 0.0) + 0.5);
        const float change = f - first(before), ahead = (second(before) - f) * change > 0.0 ? 0.0 : momentum;
        const float g = floor(f + ahead * change + 0.5);
        const int after = packed(f, g);
        hasChanged = hasChanged || after != before;
        recoils[at].taken = uint(after);
        sum += g * RECOIL_UNIT * recoil.most * n;
    }
    const bool isNew = hasChanged && own.w < 0.0;
    const vec4 motion = vec4(velocity.xyz + velocity.w * sum, isNew ? -own.w : own.w);
    if (isOdd) even[i] = motion;
    else odd[i] = motion;
    if (hasChanged) changes[round & 1u] = 1u;
    if (isNew) reachPartners(i);
}

// Adds recoils to the forces on partners that do not give way, which are no members: of the members that name one, the
// first in its list adds for all.
void addStillForces(uint i) {
    for (uint c = 0u; c < (keepsForces ? degreeOf(i) : 0u); ++c) {
        const uint other = recoils[RECOIL_CONTACTS * i + c].other, still = other & ~RECOIL_STILL;
        if (other == RECOIL_FIXED || other == still) continue;
        uint named = ~0u;
        vec3 sum = vec3(0.0);
        for (uint slot = lists[still].x; slot < lists[still].x + lists[still].y; ++slot) {
            const uint k = contactAt(slot).x;
            for (uint d = 0u; d < degreeOf(k); ++d) {
                const Recoil recoil = recoils[RECOIL_CONTACTS * k + d];
                if (recoil.other != other) continue;
                if (named == ~0u) named = k;
                sum -= takenBy(recoil);
            }
        }
        if (named == i) addContactForce(still, sum);
    }
}

void end(uint i) {
    vec3 sum = vec3(0.0), fixedly = vec3(0.0);
    for (uint c = 0u; c < degreeOf(i); ++c) {
        const Recoil recoil = recoils[RECOIL_CONTACTS * i + c];
        const vec3 impulse = takenBy(recoil);
        if (recoil.other == RECOIL_FIXED) fixedly += impulse;
        else sum += impulse;
    }
    addContactForce(i, sum);
    addFixedForce(i, fixedly);
    const vec3 change = velocities[i].w * (sum + fixedly), way = step.thetaH * change;
    if (change == vec3(0.0)) return;
    velocities[i].xyz += change;
    const uint r = hasRemainders ? remainderOf(state.length(), i) : i;
    const Sum moved = exactSum(state[i].xyz, hasRemainders ? way + state[r].xyz : way);
    state[i].xyz = moved.rounded;
    if (hasRemainders) state[r].xyz = moved.remainder;
}

void main() {
    const uint count = arguments[push.substep].unused0;
    if (gl_LocalInvocationID.x == 0u) {
        changes[0] = 1u;
        changes[1] = 0u;
        reached = 0u;
    }
    synchronize();
    FOR_EACH(m, 0u, count) reach(members[m]);
    synchronize();
    FOR_EACH(m, 0u, count) prepare(memberAt(m), true);
    synchronize();
    FOR_EACH(m, 0u, count) reachPartners(memberAt(m));
    synchronize();
    uint prepared = count;
    for (uint round = 1u; round <= RECOIL_ROUNDS; ++round) {
        const uint listed = reached;
        const bool hasChanged = changes[(round + 1u) & 1u] != 0u;
        FOR_EACH(m, prepared, listed) prepare(memberAt(m), false);
        prepared = listed;
        synchronize();
        if (!hasChanged) break;
        if (gl_LocalInvocationID.x == 0u) changes[(round + 1u) & 1u] = 0u;
        if ((round & 1u) != 0u) FOR_EACH(m, 0u, listed) iterate(memberAt(m), round, true);
        else FOR_EACH(m, 0u, listed) iterate(memberAt(m), round, false);
        synchronize();
    }
    FOR_EACH(m, 0u, prepared) end(memberAt(m));
    FOR_EACH(m, 0u, prepared) addStillForces(memberAt(m));
}
