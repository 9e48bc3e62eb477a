// Lists of the contacts of a substep (touched.h), for passes that need not visit all candidates. Without TOUCHED_BINDING
// a kernel that visits rows has these lists in a block `touched`.
layout(constant_id = 9) const uint touchedSlots = 0u; // slots of the state; 0 = the pass has no such lists

// Rows are last: they may be more than slots.
uint firstTouched(uint list) { return TOUCHED_MARKS + touchedSlots * (list == TOUCHED_PARTICLES ? 1u : list == TOUCHED_POINTS ? 2u : 3u); }

#ifdef TOUCHED_BINDING
// Requires TOUCHED_BINDING: the arguments of the passes over the lists that a kernel makes, from FIRST_TOUCHED on, and
// the lists.
layout(std430, binding = TOUCHED_BINDING) buffer TouchedArguments { DispatchArguments touchedArguments[]; };
layout(std430, binding = TOUCHED_BINDING + 1) buffer Touched { uint touched[]; };

// Makes the pass over a list long enough for so many items.
void planTouched(uint list, uint items) {
    atomicMax(touchedArguments[list - FIRST_TOUCHED].groupsX, min((items - 1u) / GROUP_SIZE + 1u, uint(ROWS_MOST_GROUPS)));
}

void listTouched(uint list, uint item) {
    const uint place = atomicAdd(touched[list], 1u);
    touched[firstTouched(list) + place] = item;
    planTouched(list, place + 1u);
}

// Lists four particles, each only once in a substep. One count takes all four: atomics wait for each other.
void listTouchedParticles(uint i, uint a, uint b, uint c) {
    const uint substep = touched[TOUCHED_SUBSTEP];
    const uvec4 all = uvec4(i, a, b, c);
    const uvec4 before = uvec4(atomicExchange(touched[TOUCHED_MARKS + i], substep), atomicExchange(touched[TOUCHED_MARKS + a], substep),
                               atomicExchange(touched[TOUCHED_MARKS + b], substep), atomicExchange(touched[TOUCHED_MARKS + c], substep));
    const uvec4 isNew = uvec4(notEqual(before, uvec4(substep)));
    const uint count = isNew.x + isNew.y + isNew.z + isNew.w;
    if (count == 0u) return;
    uint place = atomicAdd(touched[TOUCHED_PARTICLES], count);
    planTouched(TOUCHED_PARTICLES, place + count);
    for (uint k = 0u; k < 4u; ++k)
        if (isNew[k] != 0u) touched[firstTouched(TOUCHED_PARTICLES) + place++] = all[k];
}
#endif

// Loop over the rows that touch or remember something: one row an invocation, or several if there are more rows than
// invocations (ROWS_MOST_GROUPS).
#define FOR_EACH_TOUCHED_ROW(row) for (uint row = gl_GlobalInvocationID.x; row < touched[TOUCHED_ROWS]; row += gl_NumWorkGroups.x * GROUP_SIZE)
#define touchedRow(row) touched[firstTouched(TOUCHED_ROWS) + (row)]

#ifdef TOUCHED_LIST
// The item of this invocation, of a pass over TOUCHED_LIST; ~0 = none. A kernel without TOUCHED_BINDING has these lists
// in place of its list of work groups.
#ifdef TOUCHED_BINDING
#define TOUCHED(k) touched[k]
#else
#define TOUCHED(k) listedItems[k]
#endif
uint touchedItem() {
    const uint k = gl_GlobalInvocationID.x, n = TOUCHED(TOUCHED_LIST);
    return k < n ? TOUCHED(firstTouched(TOUCHED_LIST) + (isReversed ? n - 1u - k : k)) : ~0u;
}
#endif
