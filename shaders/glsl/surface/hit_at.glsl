// Position of the cut on a link: the part of the way from its owner, node i, to the other end.
float hitAt(uint i, int bit) {
    const int k = kuhnIndexOf(bit);
    const uint value = bitfieldExtract(k < 4 ? hits[i].low : hits[i].high, 8 * (k & 3), 8);
    return value > 0u ? float(value) / 255.0 : 0.5;
}
