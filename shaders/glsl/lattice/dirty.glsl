// Part of the kernels that cut and of those that follow them: a bit for each slot near links that died. The including
// kernel defines the buffer dirty[] and a range of slots, push.first and push.count, with its strides.

bool isDirty(uint slot) { return (dirty[slot >> 5] >> (slot & 31u) & 1u) != 0u; }

#ifdef MARKS_DIRTY
// Marks a slot and its two neighbours in the row.
void markRow(int slot) {
    const int low = max(slot - 1, int(push.first)), high = min(slot + 1, int(push.first + push.count) - 1);
    if (low > high) return;
    const uint bits = (2u << high - low) - 1u, shift = uint(low) & 31u;
    atomicOr(dirty[low >> 5], bits << shift);
    if (low >> 5 != high >> 5) atomicOr(dirty[high >> 5], bits >> 32u - shift);
}

// Marks all nodes within one step of i in x, y and z: nothing that depends on a cell at i is farther away.
void markAround(uint i) {
    const int rows = push.rowStride > 0u ? 1 : 0;
    for (int z = -1; z <= 1; ++z)
        for (int y = -rows; y <= rows; ++y) markRow(int(i) + y * int(push.rowStride) + z * int(push.sliceStride));
}
#endif
