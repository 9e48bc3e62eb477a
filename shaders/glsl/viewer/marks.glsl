// Shared by the kernels of contact marks. Requires `positions`, `bySlot`, `pieces`, `marks`, `draw` and `push`.

void mark(vec3 point, vec3 normal, float kind) {
    const uint place = atomicAdd(draw.found, 1u);
    if (place >= push.room) return;
    marks[place] = ContactMark(vec4(point, 1.0), vec4(normal, kind));
    atomicMax(draw.instanceCount, place + 1u);
}

uint particleOf(uint slot) { return min(bySlot[slot], push.count - 1u); }
vec3 placeOf(uint slot) { return positions[particleOf(slot)].xyz; }

// Lists are as at the start of the step: particles removed during the step are still in them.
bool isGone(uint slot) { return pieces[particleOf(slot)] == REMOVED_PIECE; }
