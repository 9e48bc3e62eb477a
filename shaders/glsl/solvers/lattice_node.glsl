// Part of gather_lattice: one node an invocation. Neighbours in x are neighbours in a work group, so that loads of a
// window come from the same cache lines. Sums have the order of the march, so that both forms give the same bits.
// Only one slice or one cell is in registers at a time: a GPU hides the latency of loads behind other invocations,
// and the fewer registers each needs, the more of them fit.

#ifdef VOLUME
// The impulses on node i of four of the cells around it, from cell `first` on; `cells` is their fill.
vec3 pressedBy(uint i, uint cells, uint first, float hh) {
    vec3 sum = vec3(0.0);
    [[dont_unroll]] for (uint k = first; k < first + 4u; ++k) {
        const uint lowest = i - 1u - push.rowStride - push.sliceStride + (k & 1u) + (k >> 1 & 1u) * push.rowStride
                            + (k >> 2) * push.sliceStride;
        vec4 p[8];
        [[unroll]] for (uint c = 0u; c < 8u; ++c)
            p[c] = POSITION(lowest + (c & 1u) + (c >> 1 & 1u) * push.rowStride + (c >> 2) * push.sliceStride);
        sum += ofCorner(pressCell(p, float(bitfieldExtract(cells, int(4u * k), 4)), hh), int(7u - k));
    }
    return sum;
}
#endif

void moveNode(uint i, Substep substep) {
    const uint cellWord = CELLS(i), alive = LINKS(i);
    const Fill fill = unpack(cellWord);
    const int home = homeOf(0);
    vec4 slice[SLICE], other[SLICE]; // the first holds the node alone
    slice[home] = POSITION(i);
    loadSlice(i - push.sliceStride, other);
    SYMMETRIC bearing, others;
    vec3 sum = gather(slice, other, home, fill, alive, -1, substep.hh, bearing);
    loadSlice(i, other);
    sum += gather(slice, other, home, fill, alive, 0, substep.hh, others);
    if (findsTimes) bearing += others;
    loadSlice(i + push.sliceStride, other);
    sum += gather(slice, other, home, fill, alive, 1, substep.hh, others);
    if (findsTimes) bearing += others;
#ifdef VOLUME
#ifdef HAS_WHOLE_CELLS
    const uint pressed = wholeCells[i];
#else
    const uint pressed = cellWord;
#endif
    sum += pressedBy(i, pressed, 0u, substep.hh) + pressedBy(i, pressed, 4u, substep.hh);
#endif
    vec4 y = slice[home];
    const vec4 velocity = velocities[i];
    if (findsTimes) {
#ifdef VOLUME
        bearing += borneByCells(unpack(pressed));
#endif
        y.w = timeFor(bearing, timesAtRest[i], y.w, velocity.w);
    }
    advance(i, y, velocity, sum, substep);
}
