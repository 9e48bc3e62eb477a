#version 460
// Keeps every particle out of the colliders at the end of a substep, one collider after another in the invocation of
// the particle: the last pass of a substep, and exact, because no mass is divided among contacts. Serves every
// solver: thetaH is 0 except for `split`; the substep of `gauss_seidel` is still open (solve_attachments.comp).
// hasRebound: the scene has restitution, so that the displacement since the start of the substep is no longer h v,
// and impacts need the velocity from before. hasContacts: particles touch each other; one that was stopped on its
// way has a velocity that differs from its displacement / h. Of many colliders a particle tests those that are near its
// work group (near_colliders.glsl).
#extension GL_GOOGLE_include_directive : require
#define MAY_RUN_LISTED
#include "common/kernel.glsl"
#include "rigid/colliders.glsl"
#ifndef OPEN
#include "common/remainder.glsl"
#endif

#include "common/fetched.glsl"
layout(std430, binding = 0) readonly buffer Colliders { Collider colliders[]; };
TEXEL_TWIN(0, samplerBuffer, colliderTexels);
Collider colliderAt(uint c) {
    if (!usesTexels) return colliders[c];
    const vec4 core = texelFetch(colliderTexels, 2 * int(c)), more = texelFetch(colliderTexels, 2 * int(c) + 1);
    return Collider(core, more.x, more.y, more.z, floatBitsToUint(more.w));
}
layout(std430, binding = 1) readonly buffer Poses { ColliderPose poses[]; };
TEXEL_TWIN(1, samplerBuffer, poseTexels);
ColliderPose poseAt(uint p) {
    if (usesTexels) return ColliderPose(texelFetch(poseTexels, 2 * int(p)), texelFetch(poseTexels, 2 * int(p) + 1));
    return poses[p];
}
layout(std430, binding = 2) readonly buffer ContactOffsets { float contactOffsets[]; };
#ifdef OPEN
layout(std430, binding = 3) readonly buffer Positions { vec4 positions[]; }; // predicted; w = inverse mass [1/kg]
#else
layout(std430, binding = 3) buffer Positions { vec4 positions[]; }; // x + thetaH v (remainder.glsl)
#endif
layout(std430, binding = 4) buffer Velocities { vec4 velocities[]; }; // open: v + h g; w = inverse mass [1/kg]
layout(std140, binding = 5) uniform Step { StepParams step; };
#ifdef OPEN
layout(std430, binding = 6) buffer Corrections { vec4 corrections[]; }; // ParticleCorrection
const bool hasRebound = true;
#else
layout(std430, binding = 6) readonly buffer Before { vec4 before[]; }; // x, v of each particle (save_substep_start)
layout(std430, binding = 7) readonly buffer Predicted { vec4 predicted[]; }; // before contacts
layout(std430, binding = 8) readonly buffer PredictedVelocities { vec4 predictedVelocities[]; };
layout(constant_id = 6) const bool hasRebound = false;
layout(constant_id = 7) const bool hasContacts = false;
#endif
layout(push_constant) uniform Push { ColliderPush push; };
#include "forces/forces.glsl"

layout(std430, binding = FORCES_BINDING + 2) readonly buffer Near { uint near[]; }; // find_near_colliders
#include "rigid/near_colliders.glsl"

#include "rigid/collider_forces.glsl"
#ifndef OPEN
#include "forces/receive.glsl"
#endif

// A particle before colliders act on it.
struct Start {
    vec4 velocity;       // w = inverse mass
    vec3 velocityBefore; // of the substep; only where something may rebound
    Movement movement;
};

// Part of v that has not moved x.
vec3 lateOf(float h) { return push.lateKick * h * step.gravity.xyz; }

Start startOf(uint i) {
    const vec4 velocity = velocities[i];
    const float h = step.h;
    const vec3 late = lateOf(h);
#ifdef OPEN
    const vec3 correction = corrections[i].xyz;
    return Start(velocity, velocity.xyz - h * step.gravity.xyz,
                 Movement(positions[i].xyz + correction, velocity.xyz + correction / h,
                          h * (velocity.xyz - late) + correction, vec3(0.0)));
#else
    const vec3 x = positions[i].xyz - step.thetaH * velocity.xyz;
    Start start = Start(velocity, vec3(0.0), Movement(x, velocity.xyz, h * (velocity.xyz - late), vec3(0.0)));
    if (hasRebound) {
        start.movement.way = x - before[2u * i].xyz;
        start.velocityBefore = before[2u * i + 1u].xyz;
    } else if (hasContacts) {
        const vec3 way = x - (predicted[i].xyz - h * predictedVelocities[i].xyz);
        if (largest(way - start.movement.way) > 1e-4 * largest(way) + 1e-5 * largest(x)) { // else h v is more exact
            start.movement.pushed = way - start.movement.way;
            start.movement.way = way;
        }
    }
    return start;
#endif
}

void main() {
    const uint i = itemIndex(push.count);
    const Start start = startOf(i);
    const vec4 velocity = start.velocity;
    const float h = step.h;
    Movement movement = start.movement;
    if (velocity.w == 0.0) return;
    const vec3 wayBefore = movement.way;
    vec3 rebound = vec3(0.0);
    bool isTouching = false;
    const uint record = nearRecord(i);
    bool testsNear = findsNear && isRegarded(record, movement.x - movement.way, movement.x);
    for (uint c = nextTested(testsNear, record, 0u); c < colliderCount; c = nextTested(testsNear, record, c + 1u)) {
        vec3 n, surfaceVelocity;
        const Collider collider = colliderAt(c);
        if (c < hostColliderCount && colliders[c].isAbsent != 0u) continue; // a device may read this integer as 0 from float texels
        const ColliderPose from = poseAt(push.before + c), to = poseAt(push.after + c); // equal where nothing moves
        const vec3 unforced = movement.v + rebound;
        if (!projectOut(collider, contactOffsets[i], from, to, h, movement, n, surfaceVelocity)) continue;
        if (findsNear) testsNear = testsNear && isRegarded(record, movement.x - movement.way, movement.x);
        isTouching = true;
        if (hasRebound)
            rebound += reboundFrom(collider, step.restSpeed, n, surfaceVelocity, start.velocityBefore, movement.v + rebound);
        const vec3 impulse = (movement.v + rebound - unforced) / velocity.w, arm = movement.x - to.position.xyz;
        addColliderForce(c, i, impulse, arm);
#ifndef OPEN
        if (collider.restitution > 0.0) receive(impulse);
        else receiveFixed(impulse, surfaceVelocity, rowElement(sumsWhole ? 0u : c, i), arm);
#endif
    }
    if (!isTouching) return;
#ifdef OPEN
    // Closing the substep adds the corrections / h to v: the part that must not add velocity is subtracted from v
    // beforehand.
    corrections[i].xyz = movement.way - h * (velocity.xyz - lateOf(h));
    velocities[i].xyz = velocity.xyz + rebound - movement.pushed / h;
#else
    const vec3 v = movement.v + rebound;
    velocities[i].xyz = v;
    addReceived(i);
    if (hasRemainders) {
        const uint r = remainderOf(positions.length(), i);
        const vec3 change = movement.way - wayBefore + step.thetaH * (v - velocity.xyz);
        const Sum sum = exactSum(positions[i].xyz, change + positions[r].xyz);
        positions[i].xyz = sum.rounded;
        positions[r].xyz = sum.remainder;
    } else {
        positions[i].xyz = movement.x + step.thetaH * v;
    }
#endif
}
