// Converts a chain of pairs to a list sorted by the other owner, so that sums over it do not depend on when and how
// pairs were found. Requires the names of listed_pairs.glsl and ENTRIES_OF_PAIR; a kernel defines place(), which writes
// the other owner of an element, and complete(), which makes the element from it.
#define BLOCK 8
#define SHORT_LIST 256u

uint unsortedAt(uint k) { return pairs[push.room / ENTRIES_OF_PAIR + k / 4u][k % 4u]; }
void setUnsorted(uint k, uint other) { pairs[push.room / ENTRIES_OF_PAIR + k / 4u][k % 4u] = other; }

// Ranks a block of entries at a time against the whole list: registers instead of shifting.
void sortShort(uint first, uint n) {
    for (uint start = 0u; start < n; start += BLOCK) {
        uint mine[BLOCK], rank[BLOCK];
        [[unroll]] for (uint b = 0u; b < BLOCK; ++b) {
            mine[b] = unsortedAt(first + min(start + b, n - 1u));
            rank[b] = 0u;
        }
        for (uint s = 0u; s < n; ++s) {
            const uint other = unsortedAt(first + s);
            [[unroll]] for (uint b = 0u; b < BLOCK; ++b) rank[b] += other < mine[b] || other == mine[b] && s < start + b ? 1u : 0u;
        }
        [[unroll]] for (uint b = 0u; b < BLOCK; ++b)
            if (start + b < n) place(first + rank[b], mine[b]);
    }
}

void sink(uint first, uint place, uint n) {
    const uint other = unsortedAt(first + place);
    for (uint child = 2u * place + 1u; child < n; child = 2u * place + 1u) {
        if (child + 1u < n && unsortedAt(first + child) < unsortedAt(first + child + 1u)) ++child;
        if (unsortedAt(first + child) <= other) break;
        setUnsorted(first + place, unsortedAt(first + child));
        place = child;
    }
    setUnsorted(first + place, other);
}

// Heap sort, because the time of ranking is quadratic.
void sortLong(uint first, uint n) {
    for (uint k = n / 2u; k > 0u; --k) sink(first, k - 1u, n);
    for (uint last = n - 1u; last > 0u; --last) {
        const uint largest = unsortedAt(first);
        setUnsorted(first, unsortedAt(first + last));
        place(first + last, largest);
        sink(first, 0u, last);
    }
    place(first, unsortedAt(first));
}

// Sorts the n entries of a chain into elements from `first` on.
void sortChain(uint chain, uint first, uint n) {
    for (uint k = first; k < first + n; ++k) {
        setUnsorted(k, otherIn(chain));
        chain = nextIn(chain);
    }
    if (n > SHORT_LIST) sortLong(first, n);
    else sortShort(first, n);
    // A loop: in the unrolled code above every lane pays for each entry of a block that it does not have.
    for (uint k = first; k < first + n; ++k) complete(k);
}
