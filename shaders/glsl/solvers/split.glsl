// Shared by every form of `split`: its buffers, the impulse of a link, and the motion of a particle by the sum of
// impulses. `split` is a stiffness-clamped, mass-split Jacobi method as a gather. A particle reads its neighbours'
// stored positions y = x + theta h v, sums its links, kicks, drifts and writes itself: one pass and one barrier a
// substep. Both ends of a link compute bit-equal, opposite impulses, so momentum is exact.
//
//   kick   v' = f (v + k (g + w / H^2 sum_c dl_c n_c)),  dl_c = -C_c(y) min(k_c H^2, k~_c min(tau_i, tau_j))
//   drift  x' = x + h v',  y' = x' + theta h v'
//
// k is h, but (hPrevious + h) / 2 in a step's first substep: v is half a substep behind x (leapfrog), which starts
// the motion with a half-kick and follows a changing h. H is the longest h of late (sim/simulation/pace.hpp): at least
// the two of the kick, whose effect it bounds. tau_i = omega / (2 w_i sum_c k~_c) is stored in positions.w: a link's share of a
// particle is k~_c / sum k~ (solvers/shares.hpp).
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_spirv_intrinsics : require
#define ALIASED spirv_decorate(20) // the buffer is bound twice, and written through one binding: Aliased
#include "common/kernel.glsl"
#include "common/remainder.glsl"

// Stored positions: y, tau [s^2]. RESIDENT: a work group keeps a whole body in shared memory for all substeps.
#ifdef RESIDENT
layout(constant_id = 7) const uint residentSlots = 512; // slots of a body
shared vec4 resident[2 * residentSlots];
uint front = 0u, back = residentSlots; // halves that this substep reads and writes
uint firstSlot, lastSlot;              // range of the body in the state; links beyond them have a stiffness of 0
layout(std430, binding = 0) buffer Positions { vec4 positions[]; };
#define POSITION(i) resident[front + min(uint(i) - firstSlot, lastSlot - firstSlot)]
#define STORE_POSITION(i, value) resident[back + (i) - firstSlot] = value
#define REMAINDER(i) positions[remainderOf(positions.length(), i)]
#define STORE_REMAINDER(i, value) REMAINDER(i) = value
#define VELOCITY_BINDING 1
#else
#include "common/fetched.glsl"
FETCHED_VEC4(0, Positions, positionAt)
#define POSITION(i) positionAt(i)
layout(std430, binding = 1) writeonly buffer NextPositions { vec4 nextPositions[]; };
#define STORE_POSITION(i, value) nextPositions[i] = value
#define REMAINDER(i) POSITION(remainderOf(nextPositions.length(), i))
#define STORE_REMAINDER(i, value) nextPositions[remainderOf(nextPositions.length(), i)] = value
#define VELOCITY_BINDING 2
#endif
#ifdef RESIDENT
layout(std430, binding = VELOCITY_BINDING) buffer Velocities { vec4 velocities[]; }; // v [m/s], w [1/kg]
#define STORE_VELOCITY(i, value) velocities[i] = value
#define STEP_BINDING (VELOCITY_BINDING + 1)
#else
// Two buffers if a pass needs the velocities before (contacts, damped links); else the same buffer twice: a particle
// reads its own velocity and then writes it.
ALIASED layout(std430, binding = VELOCITY_BINDING) readonly buffer Velocities { vec4 velocities[]; }; // v [m/s], w [1/kg]
ALIASED layout(std430, binding = VELOCITY_BINDING + 1) writeonly buffer NextVelocities { vec4 nextVelocities[]; };
#define STORE_VELOCITY(i, value) nextVelocities[i] = value
#define STEP_BINDING (VELOCITY_BINDING + 2)
#endif
layout(std140, binding = STEP_BINDING) uniform Step { StepParams step; };
#include "rigid/planes.glsl"
layout(std140, binding = STEP_BINDING + 1) uniform Planes { PlaneCollider planes[MOST_PLANES]; };
layout(std430, binding = STEP_BINDING + 2) readonly buffer ContactOffsets { float contactOffsets[]; };
#ifdef RESIDENT
#define TIMES_BINDING (STEP_BINDING + 3)
#else
// Coarse levels: the kick of the particle's block, as gravity is one.
layout(constant_id = 23) const bool hasLevels = false;
FETCHED_UVEC2(STEP_BINDING + 3, BlockOf, blockOf)       // by slot: LevelChild, with the share of its block's kick
FETCHED_VEC4(STEP_BINDING + 4, BlockKicks, blockKickAt) // by block [m/s]
#define TIMES_BINDING (STEP_BINDING + 5)
#endif
layout(std430, binding = TIMES_BINDING) readonly buffer TimesAtRest { float timesAtRest[]; }; // tau [s^2]; for followsDirections
#define LINK_BINDING (TIMES_BINDING + 1)

// If true, a static particle stores the impulse of its links [N s] in place of its velocity, where extract_hold_impulses reads
// it.
layout(constant_id = 22) const bool keepsPulls = false;

#include "common/link_impulse.glsl"
#include "solvers/directed_clamp.glsl"

// Writes y of particle i after a displacement `way` [m] in this substep from `y` to x; `before` is the velocity at
// its start.
void store(uint i, vec4 y, vec3 before, vec3 x, vec3 v, vec3 way, Substep substep) {
    if (hasRemainders) {
        const vec3 change = REMAINDER(i).xyz + way + (step.thetaHStored * v - substep.thetaH * before);
        const Sum sum = exactSum(y.xyz, change);
        STORE_POSITION(i, vec4(sum.rounded, y.w));
        STORE_REMAINDER(i, vec4(sum.remainder, 0.0));
    } else {
        STORE_POSITION(i, vec4(x + step.thetaHStored * v, y.w));
    }
}

// Moves particle i by the sum of its links' impulses and writes it.
void advance(uint i, vec4 y, vec4 velocity, vec3 impulses, Substep substep) {
    const float w = velocity.w, h = step.h;
    vec3 v = velocity.xyz;
    if (w > 0.0) { // else 0 times a neighbouring NaN would stay for ever in a slot without a particle, which is never restored
        v += substep.impulse * w * impulses;
        v += substep.kick * step.gravity.xyz;
#ifndef RESIDENT
        if (hasLevels) {
            const uvec2 block = blockOf(i);
            if (block.y != 0u) v += uintBitsToFloat(block.y) * blockKickAt(block.x).xyz; // else 0 times a NaN of another body
        }
#endif
    }
    v *= step.velocityFactor;
    vec3 x = y.xyz - substep.thetaH * velocity.xyz + h * v;
    vec3 way = h * v;
    if (w > 0.0 && planeCount > 0u) {
        Motion motion = Motion(x, v, way);
        const float offset = contactOffsets[i];
        uint touched = 0u;
        for (uint p = 0u; p < planeCount; ++p) {
            if (projectOntoPlane(planes[p], offset, h, motion)) touched |= 1u << p;
        }
        for (uint p = 0u; p < planeCount; ++p) {
            if ((touched & 1u << p) != 0u) motion.v += rebound(planes[p], step.restSpeed, velocity.xyz, motion.v);
        }
        x = motion.x;
        v = motion.v;
        way = motion.displacement;
    }
    STORE_VELOCITY(i, vec4(keepsPulls && w == 0.0 ? substep.impulse * impulses : v, w));
    store(i, y, velocity.xyz, x, v, way, substep);
}
