#version 460
// Contacts between particles, second pass, which ends a substep of `split`: moves a particle out of all others that
// it touches at once, with a share 1 / c of its mass for each (mass-split Jacobi, c: see count_contacts). For a pair,
//
//   l = (reach - |d|) / (c_i w_i + c_j w_j),   x_i += w_i l n   and the opposite for j: momentum is exact to rounding.
//
// Friction takes back the slip t of the pair since it first touched, by at most friction x l; beyond that bound, t is
// reduced to the bound. Without this memory a pile creeps for ever. Boundary planes come last and one after another.
// v changes by the corrections / h, not by a difference of positions, whose rounding is coarser. hasMemory: each
// candidate stores its slip t and the remaining overlap of those it had when the scene was loaded. hasSurfaces:
// friction differs between pairs. Particles that met during a substep with fast particles separate along the line on
// which they met.
#extension GL_GOOGLE_include_directive : require
#define MAY_RUN_LISTED
#include "common/kernel.glsl"
#include "common/contacts.glsl"
#include "common/remainder.glsl"

#include "common/fetched.glsl"
FETCHED_VEC4(0, Touching, touchingAt)   // x, contacts x inverse mass
FETCHED_UVEC2(1, Contacts, contactAt)   // ContactCandidate
FETCHED_VEC4(2, Velocities, velocityAt) // w = inverse mass [1/kg]
#define TOUCHING(i) touchingAt(i)
#define CONTACT(i) contactAt(i)
#define VELOCITY(i) velocityAt(i)
layout(std430, binding = 3) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 4) readonly buffer Predicted { vec4 predicted[]; };         // after the links (remainder.glsl); w: not changed
layout(std430, binding = 5) writeonly buffer NextPositions { vec4 nextPositions[]; }; // x + thetaH v
layout(std430, binding = 6) writeonly buffer NextVelocities { vec4 nextVelocities[]; };
layout(std140, binding = 7) uniform Step { StepParams step; };
layout(std140, binding = 8) uniform Bounds { GridBounds bounds; };
#define FIRST_IMPACT(i) touchingAt(push.count + (i)).x // time of each particle's first impact, where isSwept
#define HITS_BINDING 9
#include "common/hit_masks.glsl"
layout(push_constant) uniform Push { ContactPush push; };
#include "collision/contact_memory.glsl"

#include "forces/forces.glsl"
#include "forces/receive.glsl"
#define RECEIVES
#include "collision/finish_substep.glsl"
#include "collision/contact_impulses.glsl"

void main() {
    const uint i = itemIndex(push.count);
    if (isPadding(bounds.listed)) return;
    const uvec2 list = lists[i];
    const vec4 self = TOUCHING(i), velocity = VELOCITY(i);
    const float w = velocity.w, h = step.h;
    takeFromRows(i);
    vec3 sum = vec3(0.0), stopping = vec3(0.0);
    const bool isSwept = bounds.isSwept != 0u;
    for (uint word = 0u; word < wordsOf(list); ++word) {
        const uvec2 hit = hits[hitWord(push.count, i, list, word)];
        const uint from = list.x + 32u * word;
        // loops of which some are empty, as in count_contacts
        for (uint lost = hit.y; lost != 0u; lost &= lost - 1u) forget(from + findLSB(lost));
        for (uint at = isSwept ? 0u : hit.x; at != 0u; at &= at - 1u)
            sum += impulseFrom(i, from + findLSB(at), self, velocity.xyz);
        for (uint at = isSwept ? hit.x : 0u; at != 0u; at &= at - 1u)
            addSwept(i, from + findLSB(at), self, velocity.xyz, sum, stopping);
    }
    addContactForce(i, (sum + stopping) / h);
    const vec3 correction = w * sum;
    const vec3 v = finish(i, self.xyz, predicted[i].w, velocity, correction, velocity.xyz + (correction + w * stopping) / h);
    // A loop: on a software device, code under a condition costs its time even if it does not run.
    for (uint once = keepsReceived && w > 0.0 && hasFew(self.w, w) ? 1u : 0u; once != 0u; --once) {
        receive(fromRebounds / w);
        receiveFixed(fromPlanes / w, vec3(0.0), rowElement(lastPlane, i), lastArm);
        storeReceived(i, 0u);
        planRecoils(v, push.count);
    }
}
