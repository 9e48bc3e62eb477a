// Part of the kernels that cut and of those that read it: where a link was cut, as a part of the way from the node that owns it.

void storeHit(uint i, int bit, float t) {
    const int k = kuhnIndexOf(bit);
    if (k < 0) return;
    const uint value = uint(round(255.0 * clamp(t, 0.02, 0.98)));
    if (k < 4) hits[i].low = bitfieldInsert(hits[i].low, value, 8 * k, 8);
    else hits[i].high = bitfieldInsert(hits[i].high, value, 8 * k - 32, 8);
}
