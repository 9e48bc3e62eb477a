// True if a pair is excluded from contacts, by the table EXCLUDED: for each `of` the index of its first partner, one
// more for the end, then the partners of all, sorted.
#ifndef ANY_EXCLUDED // a constant of kernels whose table may be missing
#define ANY_EXCLUDED true
#endif
bool isExcluded(uint of, uint partner) {
    if (!ANY_EXCLUDED) return false;
    uint low = EXCLUDED(of), high = EXCLUDED(of + 1u);
    const uint end = high;
    while (low < high) {
        const uint middle = (low + high) / 2u;
        if (EXCLUDED(middle) < partner) low = middle + 1u;
        else high = middle;
    }
    return low < end && EXCLUDED(low) == partner;
}
