#version 460
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Source { uint source[]; };
layout(std430, binding = 1) writeonly buffer Target { uint target[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < target.length())
        target[i] = source[i] + 1;
}
