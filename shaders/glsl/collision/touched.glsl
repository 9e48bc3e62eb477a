// Lists of the contacts of a substep (touched.h), for passes that need not visit all candidates.
layout(constant_id = 9) const uint touchedSlots = 0u; // slots of the state; 0 = no such lists: passes visit all candidates

// Rows are last: they may be more than slots.
uint firstTouched(uint list) { return TOUCHED_MARKS + touchedSlots * (list == TOUCHED_PARTICLES ? 1u : list == TOUCHED_POINTS ? 2u : 3u); }

#ifdef TOUCHED_BINDING
// Requires TOUCHED_BINDING: the arguments of the passes over the lists that a kernel makes, from FIRST_TOUCHED on, and
// the lists.
layout(std430, binding = TOUCHED_BINDING) buffer TouchedArguments { DispatchArguments touchedArguments[]; };
layout(std430, binding = TOUCHED_BINDING + 1) buffer Touched { uint touched[]; };

void listTouched(uint list, uint item) {
    const uint place = atomicAdd(touched[list], 1u);
    touched[firstTouched(list) + place] = item;
    atomicMax(touchedArguments[list - FIRST_TOUCHED].groupsX, min(place / GROUP_SIZE + 1u, uint(ROWS_MOST_GROUPS)));
}

void listTouchedParticle(uint i) {
    if (atomicExchange(touched[TOUCHED_MARKS + i], touched[TOUCHED_SUBSTEP]) != touched[TOUCHED_SUBSTEP]) listTouched(TOUCHED_PARTICLES, i);
}
#endif

#ifdef TOUCHED_LIST
// The item of this invocation, of a pass over TOUCHED_LIST; ~0 = none. A kernel without TOUCHED_BINDING has these lists
// in place of its list of work groups.
#ifdef TOUCHED_BINDING
#define TOUCHED(k) touched[k]
#else
#define TOUCHED(k) listedGroups[k]
#endif
uint touchedItem(uint count) {
    if (touchedSlots == 0u) return itemIndex(count);
    const uint k = gl_GlobalInvocationID.x, n = TOUCHED(TOUCHED_LIST);
    return k < n ? TOUCHED(firstTouched(TOUCHED_LIST) + (isReversed ? n - 1u - k : k)) : ~0u;
}
#endif
