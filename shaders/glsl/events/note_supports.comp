#version 460
// Counts the particles of each body at planes and colliders, at the end of a substep. A particle there lies on the
// surface up to rounding, so one within its limit of rest counts. isOpen: the substep of `gauss_seidel` is still open
// (solve_attachments.comp).
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "events/events.h"
layout(push_constant) uniform Push { EventPush push; };
#include "events/partners.glsl"
#include "common/math.glsl"
#include "common/absent.glsl"

layout(std430, binding = 2) readonly buffer Reaches { float reaches[]; }; // contact offset and limit [m]; far below 0 = never moves
layout(std430, binding = 3) readonly buffer Positions { vec4 positions[]; };   // x + thetaH v
layout(std430, binding = 4) readonly buffer Velocities { vec4 velocities[]; };
layout(std140, binding = 5) uniform Step { StepParams step; };
layout(std430, binding = 6) readonly buffer Planes { vec4 planes[]; }; // normal, offset [m]
layout(std430, binding = 7) readonly buffer Colliders { Collider colliders[]; };
layout(std430, binding = 8) readonly buffer Poses { ColliderPose poses[]; };
layout(std430, binding = 9) readonly buffer Corrections { vec4 corrections[]; }; // ParticleCorrection
#include "rigid/colliders.glsl"
layout(std430, binding = 10) readonly buffer Near { uint near[]; }; // find_near_colliders
#include "rigid/near_colliders.glsl"
layout(constant_id = 1) const uint planeCount = 0;
layout(constant_id = 5) const bool isOpen = false;

vec3 placeOf(uint i) {
    if (isOpen) return positions[i].xyz + corrections[i].xyz;
    return positions[i].xyz - step.thetaH * velocities[i].xyz;
}

bool isAtCollider(Collider collider, ColliderPose pose, float reach, vec3 x) {
    const float grown = collider.core.w + reach;
    const vec3 core = max(collider.core.xyz + min(grown, 0.0), vec3(0.0));
    return surfaceAt(core, max(grown, 0.0), toLocal(pose, x)).gap <= 0.0;
}

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const uint body = bodies[i];
    const float reach = reaches[i];
    if (body == NO_BODY || reach < -1e30 || isAbsent(positions[i].xyz)) return;
    const vec3 x = placeOf(i);
    for (uint p = 0u; p < planeCount; ++p)
        if (dot3(planes[p].xyz, x) - planes[p].w <= reach) addContact(body, push.bodies + p);
    const uint record = nearRecord(i);
    const bool testsNear = findsNear && isRegarded(record, x, x);
    for (uint c = nextTested(testsNear, record, 0u); c < colliderCount; c = nextTested(testsNear, record, c + 1u)) {
        if (c < hostColliderCount && colliders[c].isAbsent != 0u) continue;
        if (isAtCollider(colliders[c], poses[push.poses + c], reach, x)) addContact(body, push.bodies + planeCount + c);
    }
}
