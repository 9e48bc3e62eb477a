// Part of gather_split: the buffer of links in its forms, and the push constants. LINKS_PACKED: one word a link
// (layout.h). NO_LINKS: free particles only. Else a SplitLink each, with HAS_BENDS and HAS_DAMPING for scenes that
// have those. LINKS_RANGED: a range of links for each particle instead of slots, for scenes in which their numbers
// differ widely.

#ifdef LINKS_PACKED
#ifdef TEXELS
layout(binding = LINK_BINDING) uniform usamplerBuffer links;
#define LINK(i) texelFetch(links, int(i)).x
#else
layout(std430, binding = LINK_BINDING) readonly buffer Links { uint links[]; };
#define LINK(i) links[i]
#endif
layout(constant_id = 3) const uint groupEnd0 = 1; // one past the last slot of a group
layout(constant_id = 4) const uint groupEnd1 = 1;
layout(constant_id = 5) const uint groupEnd2 = 1;
layout(push_constant) uniform Push { PackedSubstepPush push; };

// Uses conditionals, because every lane would look up an array indexed by s.
float ofGroup(uint s, float values[PACKED_GROUPS]) {
    return s < groupEnd0 ? values[0] : s < groupEnd1 ? values[1] : s < groupEnd2 ? values[2] : values[3];
}
#else
#ifdef TEXELS
layout(binding = LINK_BINDING) uniform usamplerBuffer links;
#define LINK(i) texelFetch(links, int(i))
#elif !defined NO_LINKS
layout(std430, binding = LINK_BINDING) readonly buffer Links { uvec4 links[]; }; // SplitLink, in one load
#define LINK(i) links[i]
#endif
#ifdef LINKS_RANGED
layout(std430, binding = LINK_BINDING + 1) readonly buffer FirstLinks { uint firstLinks[]; }; // the last element is the end
#endif
#ifdef HAS_DAMPING
layout(push_constant) uniform Push { DampedSubstepPush push; };
#else
layout(push_constant) uniform Push { SubstepPush push; };
#endif
#endif
