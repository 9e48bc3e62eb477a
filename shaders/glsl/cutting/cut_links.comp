#version 460
// Cuts the links that the blade has swept over since the step before, or that are within the radius of a ray: clears
// their bits at both ends, in the state at the start of the step. Every listed node (find_near_links) tests the links
// that it owns, if their boxes meet that of the blade, against every quad. Bits are only ever cleared, so order and
// repetition change nothing. keepsForce: the work of the cut links gives a force on the blade.
#extension GL_GOOGLE_include_directive : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"
#include "common/blade_hit.glsl"

#include "common/blade_places.glsl"
#define POINTS_BINDING 3
#include "common/blade_points.glsl"
layout(std430, binding = 4) buffer Links { uint links[]; };
layout(std430, binding = 5) buffer Hits { LinkHits hits[]; };
layout(std430, binding = 6) buffer Dirty { uint dirty[]; };
layout(std430, binding = 7) readonly buffer Work { CutWork work; };
layout(std430, binding = 8) readonly buffer Counts { uint counts[]; };
layout(std430, binding = 9) readonly buffer Nears { uvec2 nears[]; };
#define MARKS_DIRTY
#include "lattice/dirty.glsl"
#include "cutting/hits.glsl"

#include "common/blade_sweep.glsl"
layout(constant_id = 1) const bool keepsForce = false;
#define WHOLE_SUMS_BINDING 10
#include "forces/whole_sums.glsl"

layout(std430, binding = 11) readonly buffer Cells { uint cells[]; }; // material around each node, in 1/15

// The part of linkWork that a link takes (workOf() in cut_plan.cpp): by its direction at rest or, in a solid, its angle with
// the blade, and by the material in the cells that can contain it.
float shareOf(uint i, ivec3 direction, vec3 link, vec3 normal) {
    const ivec3 steps = abs(direction);
    const int n = steps.x + steps.y + steps.z;
    const bool isSheet = push.rowStride == 0u;
    if (n == 3) return 0.0;
    uint material = 0u;
    for (int k = 0; k < 8; ++k)
        if (all(notEqual(direction, 1 - 2 * cornerOf(k)))) material += cells[i] >> 4 * k & 15u;
    const float beside = float(material) / float(15 * (isSheet ? 3 - n : 6 - 2 * n));
    if (isSheet) return (n == 1 ? 1.0 : 0.70710678) * beside;
    return sqrt(float(n)) * abs(dot(link, normal)) / max(length(link) * length(normal), 1e-30) * beside;
}

// The impulse of the blade on a link: its force times its way is the work. A blade that has hardly moved against the link
// counts as having moved by a thousandth of a cell.
void addForce(float work, vec3 way) {
    const float far = max(length(way), 1e-3 * push.spacing);
    const vec3 impulse = push.forceScale * work * blade.dt / (far * far) * way;
    for (uint axis = 0u; axis < 3u; ++axis) addWhole(0u, 2u * axis, impulse[axis]);
}

void main() {
    readBlade();
    const uint count = counts[push.run], item = itemIndex(count);
    if (item >= count) return;
    const uint i = nears[push.first + item].x;
    const vec3 a = PLACE(i), aBefore = placeBefore(i);
    LinkHits hit = hits[i];
    uint cut = 0u;
    for (uint near = nears[push.first + item].y; near != 0u; near &= near - 1u) {
        const int bit = findLSB(near);
        const uint j = uint(int(i) + offsetOf(directionOf(bit)));
        const Ends ends = Ends(aBefore, placeBefore(j), a, PLACE(j));
        const Meeting meeting = stripMeeting(ends);
        const float t = firstHit(ends, meeting);
        if (t > 1.0) continue;
        if (keepsForce && meeting.at <= 1.0) {
            const float share = shareOf(i, directionOf(bit), ends.b1 - ends.a1, meeting.normal);
            addForce(share * push.linkWork, meeting.way);
        }
        cut |= 1u << bit;
        atomicAnd(links[j], ~(1u << 25 - bit));
        setHit(hit, bit, t);
    }
    if (cut == 0u) return;
    hits[i] = hit;
    atomicAnd(links[i], ~cut);
    markAround(i);
}
