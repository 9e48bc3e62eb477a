// Breaks the rule: matrices are column-major, as in C++.
#version 460
layout(std430, binding = 0, row_major) buffer Frames { mat4x3 frame; };

void main() { frame[0] = vec3(1); }
