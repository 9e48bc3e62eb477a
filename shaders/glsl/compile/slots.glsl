// The slot of particle i in the solver's state: in the order of the scene; computed in equal full boxes; else looked
// up.
#if defined(HAS_SLOTS)
layout(std430, binding = SLOTS_BINDING) readonly buffer Slots { uint slots[]; };
layout(push_constant) uniform Push { CountPush push; };
uint slotOf(uint i) { return slots[i]; }
#elif defined(IN_BOXES)
layout(push_constant) uniform Push { BoxesPush push; };
uint slotOf(uint i) {
    const uint box = i / push.perBox, node = i - box * push.perBox;
    const uint row = node / push.nodesX, slice = row / push.nodesY;
    return push.origin + box * push.boxStride + slice * push.sliceStride + (row - slice * push.nodesY) * push.rowStride +
           (node - row * push.nodesX);
}
#else
layout(push_constant) uniform Push { CountPush push; };
uint slotOf(uint i) { return i; }
#endif
