// Several items for one invocation, on devices on which invocations cost (sim/model/many_items.hpp). A kernel tests all of them first, and then
// works for those alone that the test finds: lanes that have nothing to do wait for those that have.
layout(constant_id = 23) const uint itemsEach = 1; // 1..16; 1 = an item an invocation, without a test

const uint noItem = ~0u;

// Item k of this invocation, of `count` in all. A group has itemsEach blocks of neighbours, so lanes read side by side.
uint itemOf(uint k, uint count) {
    const uint block = gl_WorkGroupID.x * itemsEach + k, i = block * GROUP_SIZE + gl_LocalInvocationID.x;
    if (i >= count) return noItem;
    const uint place = isReversed ? count - 1u - i : i;
#ifdef LISTED
    return slots[place];
#else
    return place;
#endif
}

// The names of two functions of a kernel: whether an item may have something to do, and the work on it.
bool HAS_WORK(uint i);
void WORK_ON(uint i);

void forEachItem(uint count) {
    if (itemsEach == 1u) {
        const uint i = itemIndex(count);
        if (i != noItem) WORK_ON(i);
        return;
    }
    uint found = 0u;
    for (uint k = 0u; k < itemsEach; ++k) {
        const uint i = itemOf(k, count);
        if (i != noItem) found |= uint(HAS_WORK(i)) << k;
    }
    for (; found != 0u; found &= found - 1u) WORK_ON(itemOf(findLSB(found), count));
}
