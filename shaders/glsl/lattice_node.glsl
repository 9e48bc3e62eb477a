// Part of gather_lattice: one node an invocation. Neighbours in x are neighbours in a work group, so that loads of a window
// come from the same lines. The sum has the order of the march, so that both give the same bits. Slices are used one after
// another, so that registers hold two at most.

void moveNode(uint i, Substep substep) {
    const Fill fill = unpack(CELLS(i));
    const uint alive = LINKS(i);
    const int home = homeOf(0);
    vec4 slice[SLICE], other[SLICE];
    loadSlice(i, slice);
    loadSlice(i - push.sliceStride, other);
    vec3 sum = gather(slice, other, home, fill, alive, -1, substep.hh);
#ifdef VOLUME
#ifdef HAS_WHOLE_CELLS
    const Fill cellFill[NODES] = Fill[NODES](unpack(wholeCells[i]));
#else
    const Fill cellFill[NODES] = Fill[NODES](fill);
#endif
    vec3 onOthers[NODES], pressedBelow[NODES], pressedAbove[NODES];
    pressCells(other, slice, cellFill, false, substep.hh, onOthers, pressedBelow);
#endif
    sum += gather(slice, slice, home, fill, alive, 0, substep.hh);
    loadSlice(i + push.sliceStride, other);
    sum += gather(slice, other, home, fill, alive, 1, substep.hh);
#ifdef VOLUME
    pressCells(slice, other, cellFill, true, substep.hh, pressedAbove, onOthers);
    sum += pressedBelow[0] + pressedAbove[0];
#endif
    advance(i, slice[home], velocities[i], sum, substep);
}
