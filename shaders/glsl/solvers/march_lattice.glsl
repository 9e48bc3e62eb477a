// Part of gather_lattice: the march of an invocation through the slices of a chunk. It holds two slices, that of the
// nodes and the one above; the contribution of links to the slice below was summed when that slice was held.

uint nodeAt(uint origin, int n) {
    return origin + n % COLUMNS_X + n / COLUMNS_X * push.rowStride;
}

void march(LatticeChunk chunk, Substep substep) {
    uint origin = chunk.origin;
    vec4 slice[SLICE], above[SLICE];
    Fill fill[NODES];
    uint alive[NODES]; // links of the slice
    vec3 below[NODES]; // contribution of the links to the slice before
    SYMMETRIC bearingBelow[NODES], bearing, others;
    loadSlice(origin - push.sliceStride, slice);
    loadSlice(origin, above);
    [[unroll]] for (int n = 0; n < NODES; ++n) {
        fill[n] = unpack(CELLS(nodeAt(origin, n)));
        alive[n] = LINKS(nodeAt(origin, n));
        below[n] = gather(above, slice, homeOf(n), fill[n], alive[n], -1, substep.hh, bearingBelow[n]);
    }
#ifdef HAS_WHOLE_CELLS
    Fill whole[NODES];
    [[unroll]] for (int n = 0; n < NODES; ++n) whole[n] = unpack(wholeCells[nodeAt(origin, n)]);
#endif
#ifdef VOLUME
    vec3 pressed[NODES], pressedBelow[NODES], pressedAbove[NODES];
    pressCells(slice, above, whole, false, substep.hh, pressedAbove, pressedBelow);
#endif
    for (uint layer = 0u; layer < chunk.layers; ++layer) {
        slice = above;
        loadSlice(origin + push.sliceStride, above);
#ifdef VOLUME
        [[unroll]] for (int n = 0; n < NODES; ++n) pressed[n] = pressedBelow[n];
        pressCells(slice, above, whole, true, substep.hh, pressedAbove, pressedBelow);
#endif
        [[unroll]] for (int n = 0; n < NODES; ++n) {
            const uint i = nodeAt(origin, n);
            const int home = homeOf(n);
            vec3 sum = below[n] + gather(slice, slice, home, fill[n], alive[n], 0, substep.hh, bearing);
            sum += gather(slice, above, home, fill[n], alive[n], 1, substep.hh, others);
            vec4 y = slice[home];
            const vec4 velocity = velocities[i];
            if (findsTimes) {
                bearing = bearingBelow[n] + bearing + others;
#ifdef VOLUME
                bearing += borneByCells(whole[n]);
#endif
                y.w = timeFor(bearing, timesAtRest[i], y.w, velocity.w);
            }
#ifdef VOLUME
            sum += pressed[n] + pressedAbove[n];
#endif
#ifdef HAS_WHOLE_CELLS
            whole[n] = unpack(wholeCells[i + push.sliceStride]);
#endif
            fill[n] = unpack(CELLS(i + push.sliceStride));
            alive[n] = LINKS(i + push.sliceStride);
            below[n] = gather(above, slice, home, fill[n], alive[n], -1, substep.hh, bearingBelow[n]);
            advance(i, y, velocity, sum, substep);
        }
        origin += push.sliceStride;
    }
}
