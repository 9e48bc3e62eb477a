// Places in the buffer of received.glsl.
layout(constant_id = 23) const uint receivedSlots = 0; // slots of the state; 0 = nothing is kept
const bool keepsReceived = receivedSlots > 0u;

const uint isOfFace = 0x80000000u; // beside an element of the forces: the particle has the impulse as a contact force, too

uint sectionElement(uint section, uint i) { return 1u + section * receivedSlots + i; }
