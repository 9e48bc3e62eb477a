// What kernels of contact marks share; whoever includes this says `positions`, `bySlot`, `marks`, `draw` and `push`.

void mark(vec3 point, vec3 normal, float kind) {
    const uint place = atomicAdd(draw.found, 1u);
    if (place >= push.room) return;
    marks[place] = ContactMark(vec4(point, 1.0), vec4(normal, kind));
    atomicMax(draw.instanceCount, place + 1u);
}

vec3 placeOf(uint slot) {
    return positions[min(bySlot[slot], push.count - 1u)].xyz;
}
