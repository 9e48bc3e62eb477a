// Stores the position of a cut on a link, as a part of the way from the node that owns the link.

void setHit(inout LinkHits hit, int bit, float t) {
    const int k = kuhnIndexOf(bit);
    if (k < 0) return;
    const uint value = uint(roundEven(255.0 * clamp(t, 0.02, 0.98)));
    if (k < 4) hit.low = bitfieldInsert(hit.low, value, 8 * k, 8);
    else hit.high = bitfieldInsert(hit.high, value, 8 * k - 32, 8);
}
