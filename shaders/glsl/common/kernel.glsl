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

// The item of this invocation; the caller returns if it is >= count.
#ifdef AWAKE
// In a scene that sleeps: runs only the work groups with an awake particle (list_awake.comp).
layout(std430, binding = LAST_BINDING) readonly buffer AwakeGroups { uint awakeGroups[]; };
uint itemIndex(uint count) {
    const uint place = isReversed ? gl_NumWorkGroups.x - 1u - gl_WorkGroupID.x : gl_WorkGroupID.x;
    const uint lane = isReversed ? GROUP_SIZE - 1u - gl_LocalInvocationID.x : gl_LocalInvocationID.x;
    return awakeGroups[place] * GROUP_SIZE + lane;
}
#elif defined LISTED
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
