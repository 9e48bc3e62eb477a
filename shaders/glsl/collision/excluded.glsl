// True if a pair is excluded from contacts, by the table EXCLUDED: for each `of` the index of its first partner, one
// more for the end, then the partners of all, sorted.
#ifndef ANY_EXCLUDED // a constant of kernels whose table may be missing
#define ANY_EXCLUDED true
#endif
bool isExcluded(uint of, uint partner) {
    if (!ANY_EXCLUDED) return false;
    uint low = EXCLUDED(of), n = EXCLUDED(of + 1u) - low;
    const bool isAny = n > 0u;
    while (n > 1u) {
        const uint middle = n / 2u; // of what is left
        low += EXCLUDED(low + middle) <= partner ? middle : 0u;
        n -= middle;
    }
    return isAny && EXCLUDED(low) == partner;
}
