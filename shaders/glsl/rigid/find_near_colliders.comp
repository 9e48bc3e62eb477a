#version 460
// Finds the colliders near each work group of particles, once a step, where there are many (near_colliders.glsl). The
// box holds all places that particles reach in a step at their fastest speed, with what gravity and 2 m/s add, and
// with what near colliders may take them along. A particle that leaves it, as after an impact, is no error.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "rigid/colliders.glsl"
#include "common/group_box.glsl"
#define WRITES_NEAR
#include "rigid/near_colliders.glsl"

layout(std430, binding = 0) readonly buffer Colliders { Collider colliders[]; };
layout(std430, binding = 1) readonly buffer Poses { ColliderPose poses[]; };
layout(std430, binding = 2) readonly buffer ContactOffsets { float contactOffsets[]; }; // far below 0 = no particle
layout(std430, binding = 3) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 4) readonly buffer Velocities { vec4 velocities[]; };
layout(std140, binding = 5) uniform Step { StepParams step; };
layout(std430, binding = 6) writeonly buffer Near { uint near[]; };
layout(push_constant) uniform Push { NearPush push; };

shared uint found[nearWords], farthestWay; // as ordered()

// The places of particles in a step, and their longest path in a substep [m].
struct Around {
    vec3 low, high;
    float way, offset;
};

// Lower bound of the distance of a box, with half its size, from a collider [m].
float leastGap(vec3 core, float radius, ColliderPose pose, vec3 middle, vec3 size) {
    const vec4 inverse = vec4(-pose.rotation.xyz, pose.rotation.w);
    const vec3 extent = abs(rotated(inverse, vec3(size.x, 0.0, 0.0))) + abs(rotated(inverse, vec3(0.0, size.y, 0.0))) +
                        abs(rotated(inverse, vec3(0.0, 0.0, size.z)));
    return length(max(abs(toLocal(pose, middle)) - extent - core, 0.0)) - radius;
}

// The motion of a collider in the step, seen from points as far as `reach` [m]. Turns are at most half turns, whose arcs
// are up to 1.12 of the chord of the quaternions.
float wayOf(ColliderPose from, ColliderPose to, float reach) {
    return length(to.position.xyz - from.position.xyz) + 2.3 * length(to.rotation - from.rotation) * reach;
}

// If the path of a particle in a substep, seen from a collider, is shorter than the sum of the gaps at its ends,
// they do not meet (contactOf). No gap in the step is below the mean of those at its ends minus half of the
// collider's way. False for NaN.
bool isFar(Collider collider, ColliderPose from, ColliderPose to, Around around) {
    const vec3 middle = 0.5 * (around.low + around.high), size = 0.5 * (around.high - around.low);
    const float grown = collider.core.w + around.offset, radius = max(grown, 0.0);
    const vec3 core = max(collider.core.xyz + min(grown, 0.0), vec3(0.0));
    const float way = wayOf(from, to, max(length(middle - from.position.xyz), length(middle - to.position.xyz)) + length(size));
    const float rounding = 1e-5 * (largest(middle) + largest(size) + largest(from.position.xyz) +
                                   largest(to.position.xyz) + largest(core) + radius);
    return leastGap(core, radius, from, middle, size) + leastGap(core, radius, to, middle, size) >
           around.way + 2.0 * way + rounding;
}

void find(Around around) {
    const uint lane = gl_LocalInvocationID.x;
    for (uint w = lane; w < nearWords; w += GROUP_SIZE) found[w] = 0u;
    if (lane == 0u) farthestWay = ordered(0.0);
    barrier();
    for (uint c = lane; c < colliderCount; c += GROUP_SIZE) {
        if (c < hostColliderCount && colliders[c].isAbsent != 0u) continue;
        const ColliderPose from = poses[c], to = poses[push.last + c];
        if (isFar(colliders[c], from, to, around)) continue;
        atomicOr(found[c / 32u], 1u << c % 32u);
        atomicMax(farthestWay, ordered(wayOf(from, to, length(colliders[c].core.xyz) + colliders[c].core.w)));
    }
    barrier();
}

void main() {
    const uint i = itemIndex(push.count), lane = gl_LocalInvocationID.x;
    const float offset = contactOffsets[i];
    const vec3 x = positions[i].xyz;
    const GroupBox box = boxOfGroup(offset > -1e30, x, x, vec2(length(velocities[i].xyz), offset));
    const float dt = float(push.substeps) * step.h, speed = box.most.x + dt * length(step.gravity.xyz) + 2.0;
    Around around = Around(box.low - dt * speed, box.high + dt * speed, 2.0 * step.h * speed, box.most.y + push.reach);
    find(around);
    const float taken = fromOrdered(farthestWay); // equal in all of the group
    if (taken > 0.0) {
        around.low -= taken;
        around.high += taken;
        around.way += 2.0 * taken / float(push.substeps);
        barrier(); // all have read it
        find(around);
    }
    const uint record = nearRecord(i);
    for (uint w = lane; w < nearWords; w += GROUP_SIZE) near[record + NEAR_HEAD + w] = found[w];
    if (lane > 0u) return;
    for (uint axis = 0u; axis < 3u; ++axis) {
        near[record + axis] = floatBitsToUint(around.low[axis]);
        near[record + 3u + axis] = floatBitsToUint(around.high[axis]);
    }
    near[record + 6u] = floatBitsToUint(around.way);
    near[record + 7u] = stampOf(step.frame);
}
