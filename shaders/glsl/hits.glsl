// Part of the kernels that cut and of those that read it: where a link was cut, as a part of the way from the node that owns it.

void setHit(inout LinkHits hit, int bit, float t) {
    const int k = kuhnIndexOf(bit);
    if (k < 0) return;
    const uint value = uint(roundEven(255.0 * clamp(t, 0.02, 0.98)));
    if (k < 4) hit.low = bitfieldInsert(hit.low, value, 8 * k, 8);
    else hit.high = bitfieldInsert(hit.high, value, 8 * k - 32, 8);
}
