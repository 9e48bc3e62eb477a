// The slot of particle i in the solver's state: in the order of the scene, computed in equal full boxes, or looked up.
const uint IN_ORDER = 0u, IN_BOXES = 1u, IN_TABLE = 2u;
layout(constant_id = 1) const uint slotRule = IN_ORDER;
layout(std430, binding = SLOTS_BINDING) readonly buffer Slots { uint slots[]; };
layout(push_constant) uniform Push { BoxesPush push; };

uint slotOf(uint i) {
    if (slotRule == IN_ORDER) return i;
    if (slotRule == IN_TABLE) return slots[i];
    const uint box = i / push.perBox, node = i - box * push.perBox;
    const uint row = node / push.nodesX, slice = row / push.nodesY;
    return push.origin + box * push.boxStride + slice * push.sliceStride + (row - slice * push.nodesY) * push.rowStride +
           (node - row * push.nodesX);
}
