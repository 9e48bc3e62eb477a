#version 460
// Cuts the links that the blade has swept over since the step before, or that are within the radius of a ray: clears
// their bits at both ends, in the state at the start of the step. Every listed node (find_near_links) tests the links
// that it owns, if their boxes meet that of the blade, against every quad. Bits are only ever cleared, so order and
// repetition change nothing.
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
        const float t = hitOf(Ends(aBefore, placeBefore(j), a, PLACE(j)));
        if (t > 1.0) continue;
        cut |= 1u << bit;
        atomicAnd(links[j], ~(1u << 25 - bit));
        setHit(hit, bit, t);
    }
    if (cut == 0u) return;
    hits[i] = hit;
    atomicAnd(links[i], ~cut);
    markAround(i);
}
