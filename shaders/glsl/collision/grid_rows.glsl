// Three rows of cells of the hash grid, adjacent in y, up to three cells in x each, with their particles visited in
// one loop: lanes wait for the longest list among them, and the length of three rows together exceeds the mean by
// less than that of one row. Requires the names `push` and START of a kernel.
struct Rows {
    ivec3 first;
    uint width;               // cells of each
    uint start[3];            // offset from a visit to its place in the grid, by row
    uint second, third, all;  // visits before the second row, the third, and the end
};

// Rows from `first` on, but none beyond `last` in x and y.
Rows rowsFrom(ivec3 first, ivec3 last, Frame frame) {
    Rows rows;
    rows.first = first;
    rows.width = uint(min(last.x - first.x + 1, 3));
    uint count[3];
    [[unroll]] for (int row = 0; row < 3; ++row) {
        const uint slot = slotOf(first + ivec3(0, row, 0), frame);
        rows.start[row] = START(slot);
        count[row] = first.y + row <= last.y ? START(slot + rows.width) - rows.start[row] : 0u;
    }
    rows.second = count[0];
    rows.third = rows.second + count[1];
    rows.all = rows.third + count[2];
    rows.start[1] -= rows.second;
    rows.start[2] -= rows.third;
    return rows;
}

// Place of a visit in the grid, which has `total` entries.
uint placeOf(Rows rows, uint visit, uint total) {
    const uint k = visit + (visit < rows.second ? rows.start[0] : visit < rows.third ? rows.start[1] : rows.start[2]);
    return k < total ? k : k - total;
}

// True if a visited particle lies in the rows: other cells may share their slots.
bool isIn(Rows rows, uint visit, ivec3 cell) {
    const int row = visit < rows.second ? 0 : visit < rows.third ? 1 : 2;
    return cell.yz == rows.first.yz + ivec2(row, 0) && uint(cell.x - rows.first.x) < rows.width;
}
