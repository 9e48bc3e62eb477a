// Position of a cut along an edge of a skin, in 1/255, from the states of its ends (VERTEX_MOVED ...) and the hit of the
// blade on it, 0 = none. An end that this stroke has moved is on the blade. A hit is a share of the way between the ends
// as they were, so it counts only where they are still there; or where an end has moved ahead of the blade and the edge
// was met all the same.
uint rimShare(float start, float end, uint hit) {
    const bool isStart = start >= VERTEX_MOVED && start < VERTEX_OLD, isEnd = end >= VERTEX_MOVED && end < VERTEX_OLD;
    if (isStart != isEnd && (hit == 0u || (isStart ? start : end) == VERTEX_MOVED)) return isStart ? 5u : 250u;
    return hit > 0u ? hit : 128u;
}

// A bit of the word of hits: edge n was parted before this stroke. Its rims are fixed; the blade of this stroke meets a gap.
uint partedBit(uint n) { return 1u << 24u + n; }
