// An integer hash of an index; a bijection, so no two indices give the same value.
uint mixed(uint i) {
    i = (i ^ i >> 16) * 0x7feb352du;
    i = (i ^ i >> 15) * 0x846ca68bu;
    return i ^ i >> 16;
}
