// Breaks the rule: no optional feature, here 64-bit floats.
#version 460
layout(std430, binding = 0) buffer Values { double values[]; };

void main() { values[0] *= 2; }
