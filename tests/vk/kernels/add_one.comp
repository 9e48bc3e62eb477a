// Works in place: the reader must report one buffer as read and written.
#version 460
layout(local_size_x = 64) in;
layout(std430, binding = 0) buffer Values { uint values[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < values.length())
        values[i] += 1;
}
