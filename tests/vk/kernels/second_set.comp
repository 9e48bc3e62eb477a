// Breaks the rule: descriptor set 0 only.
#version 460
layout(std430, set = 1, binding = 0) buffer Values { uint values[]; };

void main() { values[0] = 1; }
