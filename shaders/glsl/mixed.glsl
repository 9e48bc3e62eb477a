// A number of an index that has nothing to do with where it lies; of two indices never the same.
uint mixed(uint i) {
    i = (i ^ i >> 16) * 0x7feb352du;
    i = (i ^ i >> 15) * 0x846ca68bu;
    return i ^ i >> 16;
}
