// Pairs found by a search, before the lists of their owners are made (sort_pairs.glsl): each is in a chain of both
// owners. A chain begins with 2 x pair + 1 for the first owner of a pair, 2 x pair + 2 for the second; 0 ends it. Behind the
// pairs and the entries of the sort are, of rows, the owners that have a pair, each once in any order, and push.points
// later the others that have a link. Requires the names bounds, PAIRS_BINDING, ENTRIES_OF_PAIR and push of a kernel; one
// that searches defines FINDS_PAIRS, and FINDS_ROWS if it finds rows.
#ifdef FINDS_PAIRS
layout(std430, binding = PAIRS_BINDING) writeonly buffer Pairs { uvec4 pairs[]; }; // both owners; the next elements of their chains
#else
layout(std430, binding = PAIRS_BINDING) buffer Pairs { uvec4 pairs[]; }; // after them, entries during the sort
#endif

uint placeOfOwner(uint k) { return 4u * (push.room / ENTRIES_OF_PAIR + (push.room + 3u) / 4u) + k; }

#ifdef FINDS_PAIRS
const uint noPair = ~0u;

// Number of found pairs at which the search ends: this bounds the time of a step.
uint mostPairs() { return 4u * (push.room / ENTRIES_OF_PAIR); }
bool isFull() { return bounds.pairs > mostPairs(); }

uint newPair() {
    const uint pair = atomicAdd(bounds.pairs, 1u);
    return pair < push.room / ENTRIES_OF_PAIR ? pair : noPair;
}

#ifdef FINDS_ROWS
void setOwner(uint k, uint owner) { pairs[placeOfOwner(k) / 4u][placeOfOwner(k) % 4u] = owner; }

// The chains of both owners before the pair.
void listOwners(uint owner, uint chain, uint other, uint chainOfOther) {
    if (chain == 0u) setOwner(atomicAdd(bounds.owners, 1u), owner);
    if (chainOfOther == 0u) setOwner(push.points + atomicAdd(bounds.linked, 1u), other);
}
#endif
#else
uint ownerAt(uint k) { return pairs[placeOfOwner(k) / 4u][placeOfOwner(k) % 4u]; }

uint nextIn(uint chain) { return chain % 2u == 1u ? pairs[(chain - 1u) / 2u].z : pairs[(chain - 1u) / 2u].w; }
uint otherIn(uint chain) { return chain % 2u == 1u ? pairs[(chain - 1u) / 2u].y : pairs[(chain - 1u) / 2u].x; }
// Length of a chain, counted up to LIST_MOST + 1.
uint lengthOf(uint chain) {
    uint n = 0u;
    for (; chain != 0u && n <= LIST_MOST; chain = nextIn(chain)) ++n;
    return n;
}
#endif
