#version 460
// Marks the islands that wake at the start of a step: all, or those with a particle at a moved anchor or near the
// path of a collider or of a driven body, treated as the ball around it; and driven particles when their body begins
// to move. Of many colliders and driven bodies each work group looks for those near it first.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "sleep/sleep.glsl"
#include "common/group_box.glsl"

layout(std430, binding = 0) readonly buffer State { SleepState state; };
layout(std430, binding = 1) readonly buffer Weights { float weights[]; };     // inverse mass of awake particles [1/kg]
layout(std430, binding = 2) readonly buffer Velocities { vec4 velocities[]; };
layout(std430, binding = 3) readonly buffer Positions { vec4 positions[]; };  // positions of sleeping particles [m]
layout(std430, binding = 4) readonly buffer Islands { uint islands[]; };
layout(std430, binding = 5) buffer Marks { uint marks[]; };
layout(std430, binding = 6) readonly buffer Attachments { AttachedParticle attachments[]; };
layout(std430, binding = 7) readonly buffer Anchors { vec4 anchors[]; };
layout(std430, binding = 8) readonly buffer SeenAnchors { vec4 seenAnchors[]; };
layout(std430, binding = 9) readonly buffer Colliders { Collider colliders[]; };
layout(std430, binding = 10) readonly buffer ContactOffsets { float contactOffsets[]; };
layout(std430, binding = 11) readonly buffer Ways { ColliderPose ways[]; };
layout(std430, binding = 12) readonly buffer SeenPoses { ColliderPose seenPoses[]; };
layout(push_constant) uniform Push { SleepPush push; };

float wayTo(vec3 x, vec3 a, vec3 b) {
    const vec3 d = b - a;
    const float t = clamp(dot(x - a, d) / max(dot(d, d), 1e-30), 0.0, 1.0);
    return length(x - a - t * d);
}

shared uint nearMovers[(MOST_MOVERS + 31) / 32]; // a bit for each, if they are many

// True if collider c moves within `distance` of x, or nearer than that by the contact offset. Tests slightly beyond the
// contact distance: a particle at rest on a collider touches it up to rounding. A kinematic collider that appears has
// no path; one that has shrunk counts with its extent before.
bool movesNear(uint c, vec3 x, float offset, float distance) {
    const ColliderPose from = seenPoses[c], to = ways[2u * c + 1u];
    const bool comes = from.position.w <= 0.0 && to.position.w > 0.0;
    const float around = max(length(colliders[c].core.xyz) + colliders[c].core.w, ways[2u * c].position.w);
    const float reach = 1.05 * (around + max(offset, 0.0));
    return from != to && wayTo(x, comes ? to.position.xyz : from.position.xyz, to.position.xyz) <= reach + distance;
}

bool isNearMoving(vec3 x, float offset) {
    bool isNear = false;
    if (push.colliders <= FEW_COLLIDERS) {
        for (uint c = 0u; c < push.colliders; ++c) isNear = isNear || movesNear(c, x, offset, 0.0);
        return isNear;
    }
    for (uint w = 0u; w < (push.colliders + 31u) / 32u; ++w)
        for (uint bits = nearMovers[w]; bits != 0u; bits &= bits - 1u)
            isNear = isNear || movesNear(32u * w + uint(findLSB(bits)), x, offset, 0.0);
    return isNear;
}

void findNearMovers(bool isIn, vec3 x, float offset) {
    for (uint w = gl_LocalInvocationID.x; w < (push.colliders + 31u) / 32u; w += GROUP_SIZE) nearMovers[w] = 0u;
    const GroupBox box = boxOfGroup(isIn, x, x, vec2(offset, 0.0));
    const vec3 middle = 0.5 * (box.low + box.high);
    const float farthest = length(box.high - middle), size = abs(middle.x) + abs(middle.y) + abs(middle.z) + farthest;
    for (uint c = gl_LocalInvocationID.x; c < push.colliders; c += GROUP_SIZE)
        if (movesNear(c, middle, box.most.x, farthest + 1e-5 * size)) atomicOr(nearMovers[c / 32u], 1u << c % 32u);
    barrier();
}

bool haveDrivenMoved() {
    bool have = false;
    for (uint c = push.colliders - push.driven; c < push.colliders; ++c) have = have || ways[2u * c + 1u] != seenPoses[c];
    return have;
}

void main() {
    const uint i = itemIndex(push.count);
    if (weights[i] == SLEEP_DRIVEN && haveDrivenMoved()) atomicOr(marks[islands[i]], 1u);
    const bool sleeps = isAsleep(weights[i], velocities[i]);
    const vec3 x = positions[i].xyz;
    const float offset = contactOffsets[i];
    if (push.colliders > FEW_COLLIDERS) findNearMovers(sleeps, x, offset);
    if (sleeps && (state.wakesAll != 0u || isNearMoving(x, offset)))
        atomicOr(marks[islands[i]], 1u);
    if (i >= push.attachments || anchors[2u * i + 1u].xyz == seenAnchors[i].xyz) return;
    const uint p = attachments[i].particle;
    if (isAsleep(weights[p], velocities[p])) atomicOr(marks[islands[p]], 1u);
}
