// Works in place, with the buffer bound once as writeonly and once as readonly.
#version 460
layout(local_size_x = 64) in;
layout(std430, binding = 0) writeonly buffer After { uint after[]; };
layout(std430, binding = 1) readonly buffer Before { uint before[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < after.length())
        after[i] = before[i] + 1;
}
