// Bits of a node's links that lead to the slot `slots` further; 0 = none does. In a body two nodes wide several
// directions may. Links that would leave the body are never alive. In a sheet, rowStride 0, there is no y.
uint linksTo(int slots, uint rowStride, uint sliceStride) {
    uint ways = 0u;
    [[dont_unroll]] for (int k = 0; k < 9; ++k) {
        const int y = k / 3 - 1, z = k % 3 - 1, x = slots - y * int(rowStride) - z * int(sliceStride);
        const bool isIn = abs(x) <= 1 && (x != 0 || k != 4) && (y == 0 || rowStride > 0u);
        if (isIn) ways |= 1u << bitOf(x, y, z);
    }
    return ways;
}
