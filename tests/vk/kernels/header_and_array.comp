// Breaks the rule: a run-time array has no fixed members before it.
#version 460
layout(std430, binding = 0) buffer Contacts { uint count; uint contacts[]; };

void main() { contacts[0] = count; }
