// Breaks the rule: bindings without gaps.
#version 460
layout(std430, binding = 0) buffer First { uint first[]; };
layout(std430, binding = 2) buffer Third { uint third[]; };

void main() { third[0] = first[0]; }
