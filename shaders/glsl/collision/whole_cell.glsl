// True if all edges of the six tetrahedra of a cell are alive. `lowest` is its lowest corner. The longest edge of an
// empty cell is not alive. Requires links[] and push constants with the strides.
bool isWholeCell(uint lowest) {
    for (int c = 0; c < 7; ++c) {
        const ivec3 corner = cornerOf(c);
        const uint alive = links[uint(int(lowest) + corner.x + corner.y * int(push.rowStride) + corner.z * int(push.sliceStride))];
        for (int d = 1; d < 8; ++d) {
            const ivec3 way = cornerOf(d);
            if ((c & d) == 0 && !isAlive(alive, way.x, way.y, way.z)) return false;
        }
    }
    return true;
}
