#version 460
// First pass of a cut: lists the nodes that own a link whose box meets that of the blade, with those links. They are
// few, and later passes process only these. The order of the list does not matter: links are cut one by one. Links of
// removed fragments, which are invisible, are left out.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/cut.glsl"
#include "lattice/link_masks.glsl"

#include "common/fetched.glsl"
FETCHED_VEC4(0, Places, placeAt)
#define PLACE(i) placeAt(i).xyz
layout(std430, binding = 1) readonly buffer Links { uint links[]; };
layout(std430, binding = 2) readonly buffer Blade { BladeHead blade; };
layout(std430, binding = 3) readonly buffer Work { CutWork work; };
layout(std430, binding = 4) buffer Counts { uint counts[]; };      // number of nodes, by run
layout(std430, binding = 5) writeonly buffer Nears { uvec2 nears[]; }; // slot, links; each run begins at its first slot
layout(constant_id = 1) const bool hasDebris = false;
layout(std430, binding = 6) readonly buffer Particles { uint particles[]; }; // one per slot
layout(std430, binding = 7) readonly buffer Pieces { uint pieces[]; };
bool isThere(uint i) { return !hasDebris || particles[i] != NO_PARTICLE && pieces[particles[i]] != REMOVED_PIECE; }

void main() {
    const uint item = itemIndex(push.count), i = push.first + min(item, push.count - 1u);
    const uint owned = item < push.count && isThere(i) ? links[i] & OWNED_MASK : 0u;
    const vec3 a = PLACE(i);
    const float margin = 1e-3 * push.spacing + (blade.isCarried != 0u ? uintBitsToFloat(work.farthest) : 0.0);
    const vec3 low = blade.low.xyz - margin, high = blade.high.xyz + margin;
    uint near = 0u;
    [[unroll]] for (int bit = FIRST_OWNED; bit < FIRST_OWNED + OWNED_LINKS; ++bit) {
        const bool isLink = (owned >> bit & 1u) != 0u; // else the node may not exist
        const vec3 b = PLACE(uint(int(i) + (isLink ? offsetOf(directionOf(bit)) : 0)));
        near |= uint(all(lessThanEqual(min(a, b), high)) && all(greaterThanEqual(max(a, b), low))) << bit;
    }
    near &= owned;
    if (near != 0u) nears[push.first + atomicAdd(counts[push.run], 1u)] = uvec2(i, near);
}
