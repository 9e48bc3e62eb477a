// Writes the arguments of an indirect dispatch of one group.
#version 460
layout(local_size_x = 1) in;
layout(std430, binding = 0) writeonly buffer Arguments { uvec4 arguments; };

void main() { arguments = uvec4(1, 1, 1, 0); }
