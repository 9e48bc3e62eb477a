// Places in the buffer of received.glsl.
layout(constant_id = 23) const uint receivedSlots = 0; // slots of the state; 0 = nothing is kept
const bool keepsReceived = receivedSlots > 0u;

uint sectionElement(uint section, uint i) { return 1u + section * receivedSlots + i; }
