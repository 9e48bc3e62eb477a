// Number of contacts of this step, by body and partner. Requires the push constants EventPush.

layout(std430, binding = 0) readonly buffer Bodies { uint bodies[]; }; // by slot
layout(std430, binding = 1) buffer Contacts { uint contacts[]; };

void addContact(uint body, uint partner) { atomicAdd(contacts[body * 32u * push.rowWords + partner], 1u); }

// Two bodies; the one with the lower index has the row.
void addMeeting(uint one, uint other) {
    if (one != other && one != NO_BODY && other != NO_BODY) addContact(min(one, other), max(one, other));
}
