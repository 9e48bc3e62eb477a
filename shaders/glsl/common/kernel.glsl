// Included first by every kernel: the shared structs, the group size, and the index of its item.
#include "common/layout.h"

#ifndef GROUP_SIZE
#define GROUP_SIZE GROUP_ITEMS
#endif
layout(local_size_x = GROUP_SIZE) in;

// Maps invocation i to count - 1 - i. The state must not change: our race and order detector.
layout(constant_id = 0) const bool isReversed = false;

// True if a step finished: all values are finite, and all contacts fitted. Else the step is undone.
bool isFinished(StatusWords status) { return (status.nonFinite | status.candidates | status.lacksLists) == 0u; }

// The place of this invocation among all of its dispatch.
uint placeOfAll() {
    const uint all = gl_NumWorkGroups.x * GROUP_SIZE;
    return isReversed ? all - 1u - gl_GlobalInvocationID.x : gl_GlobalInvocationID.x;
}

// The item of this invocation; the caller returns if it is >= count.
#if defined MAY_RUN_LISTED || defined RUNS_LISTED
// Runs over all work groups; over listed ones, those with an awake particle (list_awake.comp) or one in a contact
// (listed_groups.glsl); or over listed items, whole work groups: slots that hold a particle, or have a candidate.
#ifdef MAY_RUN_LISTED
layout(constant_id = RUNS_OVER_ID) const uint runsOver = RUNS_OVER_ALL;
#else
const uint runsOver = RUNS_OVER_GROUPS;
#endif
layout(std430, binding = LAST_BINDING) readonly buffer ListedItems { uint listedItems[]; };
uint listedGroup() {
    const uint place = isReversed ? gl_NumWorkGroups.x - 1u - gl_WorkGroupID.x : gl_WorkGroupID.x;
    return runsOver == RUNS_OVER_GROUPS ? listedItems[place] : place;
}
uint itemIndex(uint count) {
    if (runsOver >= RUNS_OVER_ITEMS) return listedItems[placeOfAll()];
    if (runsOver == RUNS_OVER_ALL) {
        const uint i = gl_GlobalInvocationID.x;
        return isReversed && i < count ? count - 1u - i : i;
    }
    const uint lane = isReversed ? GROUP_SIZE - 1u - gl_LocalInvocationID.x : gl_LocalInvocationID.x;
    return listedGroup() * GROUP_SIZE + lane;
}
// Whether the item is padding of a list of which the device knows the length.
bool isPadding(uint length) { return runsOver == RUNS_OVER_COUNTED && placeOfAll() >= length; }
#elif defined VISITS_SLOTS
// Runs over slots of the state that hold a particle, not over padding; ~0 after the last.
layout(std430, binding = LAST_BINDING) readonly buffer Slots { uint slots[]; };
uint itemIndex(uint count) {
    const uint i = gl_GlobalInvocationID.x;
    return i < count ? slots[isReversed ? count - 1u - i : i] : ~0u;
}
#else
uint itemIndex(uint count) {
    const uint i = gl_GlobalInvocationID.x;
    return isReversed && i < count ? count - 1u - i : i;
}
#endif
