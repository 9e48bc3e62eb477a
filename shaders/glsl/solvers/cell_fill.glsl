// Part of gather_lattice: fill of the cells around a node, and the weight that it gives the node's links.

// Fill of the cells around a node [1/15].
struct Fill {
    float cells[8];
};

Fill unpack(uint word) {
    Fill fill;
    [[unroll]] for (int k = 0; k < 8; ++k) fill.cells[k] = float(bitfieldExtract(word, 4 * k, 4));
    return fill;
}

// Sum over the cells that hold the link in direction (dx, dy, dz). The compiler folds it to a few additions, since
// directions are constants.
float heldBy(Fill fill, int dx, int dy, int dz) {
    float sum = 0.0;
    [[unroll]] for (int k = 0; k < 8; ++k) {
        const ivec3 side = 2 * (ivec3(k) >> ivec3(0, 1, 2) & 1) - 1;
        const bool isBeside = (dx == 0 || dx == side.x) && (dy == 0 || dy == side.y) && (dz == 0 || dz == side.z);
#ifdef SHEET
        if (isBeside && side.y < 0) sum = max(sum, fill.cells[k]);
#else
        if (isBeside) sum += fill.cells[k];
#endif
    }
    return sum;
}
