// Breaks the rule: uniform blocks have at most 16 KiB.
#version 460
layout(std140, binding = 0) uniform Step { vec4 gravity[1025]; } params;
layout(std430, binding = 1) buffer Values { vec4 values[]; };

void main() { values[0] = params.gravity[0]; }
