// Part of gather_split: the buffer of links in its forms, and the push constants. LINKS_PACKED: one word a link
// (layout.h). Else a SplitLink each. LINKS_RANGED: a range of links for each particle instead of slots, for scenes in
// which their numbers differ widely.

#ifdef LINKS_PACKED
FETCHED_UINT(LINK_BINDING, Links, linkAt)
#define LINK(i) linkAt(i)
layout(constant_id = 3) const uint groupEnd0 = 1; // one past the last slot of a group
layout(constant_id = 4) const uint groupEnd1 = 1;
layout(constant_id = 5) const uint groupEnd2 = 1;
layout(push_constant) uniform Push { PackedSubstepPush push; };

// Uses conditionals, because every lane would look up an array indexed by s.
float ofGroup(uint s, float values[PACKED_GROUPS]) {
    return s < groupEnd0 ? values[0] : s < groupEnd1 ? values[1] : s < groupEnd2 ? values[2] : values[3];
}
#else
FETCHED_UVEC4(LINK_BINDING, Links, linkAt) // SplitLink
#define LINK(i) linkAt(i)
#ifdef LINKS_RANGED
layout(std430, binding = LINK_BINDING + 1) readonly buffer FirstLinks { uint firstLinks[]; }; // the last element is the end
#endif
layout(push_constant) uniform Push { DampedSubstepPush push; };
#endif
