#version 460
// Lists the particles inside a region, in any order: the host sorts. The region is a box grown by a radius.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "simulation/pick.h"
#include "common/absent.glsl"

layout(std430, binding = 0) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Pieces { uint pieces[]; };
layout(std430, binding = 2) readonly buffer InverseMasses { float inverseMasses[]; };
layout(std430, binding = 3) buffer Found { uint found[]; }; // the number of all, then the indices of those that fit
layout(push_constant) uniform Push { WithinPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count || pieces[i] == REMOVED_PIECE || isAbsent(positions[i].xyz)) return;
    if (push.isMoving != 0u && inverseMasses[i] == 0.0) return;
    const vec3 beyond = max(abs(positions[i].xyz - push.center.xyz) - push.halfExtents.xyz, vec3(0.0));
    if (dot(beyond, beyond) > push.center.w * push.center.w) return;
    const uint place = atomicAdd(found[0], 1u);
    if (place < push.room) found[1u + place] = i;
}
