#version 460
// Cuts the links that the blade has swept over since the step before, or that a ray comes near: clears their bits at both ends, in
// the state that the step begins with. Every node tests the links that it owns; first their box against that of the blade, then
// what is left against every quad. Bits are only ever cleared, so order and repetition change nothing.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "cut.glsl"
#include "link_masks.glsl"
#include "blade_hit.glsl"

#ifdef TEXELS
layout(binding = 0) uniform samplerBuffer places;
#define PLACE(i) texelFetch(places, int(i)).xyz
#else
layout(std430, binding = 0) readonly buffer Places { vec4 places[]; };
#define PLACE(i) places[i].xyz
#endif
layout(std430, binding = 1) readonly buffer PlacesBefore { vec4 before[]; };
layout(std430, binding = 2) buffer Links { uint links[]; };
layout(std430, binding = 3) buffer Hits { LinkHits hits[]; };
layout(std430, binding = 4) writeonly buffer Dirty { uint dirty[]; };
layout(std140, binding = 5) uniform Blade { BladeHead blade; };
layout(std430, binding = 6) readonly buffer Points { vec4 points[]; };
layout(std430, binding = 7) readonly buffer Work { CutWork work; };
layout(std430, binding = 8) readonly buffer SavedLinks { uint savedLinks[]; }; // before this blade, whatever is cut meanwhile
#include "hits.glsl"

#include "blade_sweep.glsl"

uint wordOf(int slot) { return uint(clamp(slot - int(push.first), 0, int(push.count) - 1) + int(push.first)) >> 5; }

// Links of nodes within a step of i may now hang on others that died: marks those nodes.
void markAround(uint i) {
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y) {
            const int row = int(i) + offsetOf(ivec3(0, y, z));
            dirty[wordOf(row - 1)] = 1u;
            dirty[wordOf(row + 1)] = 1u;
        }
}

void main() {
    const uint item = itemIndex(push.count), i = push.first + min(item, push.count - 1u);
    const uint owned = item < push.count ? links[i] & OWNED_MASK : 0u;
    const vec3 a = PLACE(i);
    const float margin = 1e-3 * push.spacing + (blade.isCarried != 0u ? uintBitsToFloat(work.farthest) : 0.0);
    const vec3 low = blade.low.xyz - margin, high = blade.high.xyz + margin;
    uint near = 0u;
    [[unroll]] for (int bit = FIRST_OWNED; bit < FIRST_OWNED + OWNED_LINKS; ++bit) {
        const bool isLink = (owned >> bit & 1u) != 0u; // else there may be no such node
        const vec3 b = PLACE(uint(int(i) + (isLink ? offsetOf(directionOf(bit)) : 0)));
        near |= uint(all(lessThanEqual(min(a, b), high)) && all(greaterThanEqual(max(a, b), low))) << bit;
    }
    near &= owned;
    const vec3 aBefore = near != 0u ? placeBefore(i) : a;
    uint cut = 0u;
    while (near != 0u) {
        const int bit = findLSB(near);
        near &= near - 1u;
        const uint j = uint(int(i) + offsetOf(directionOf(bit)));
        const vec3 b = PLACE(j);
        const float t = hitOf(Ends(aBefore, placeBefore(j), a, b));
        if (t > 1.0) continue;
        cut |= 1u << bit;
        atomicAnd(links[j], ~(1u << 25 - bit));
        storeHit(i, bit, t);
    }
    if (cut == 0u) return;
    atomicAnd(links[i], ~cut);
    markAround(i);
}
