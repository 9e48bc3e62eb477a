// A deliberate race: every invocation reads a value that another one writes. Two runs with the order switch
// differ.
#version 460
layout(local_size_x = 64) in;
layout(constant_id = 0) const bool isReversed = false;
layout(std430, binding = 0) buffer Values { uint values[]; };

void main() {
    const uint count = values.length();
    if (gl_GlobalInvocationID.x >= count)
        return;
    const uint i = isReversed ? count - 1 - gl_GlobalInvocationID.x : gl_GlobalInvocationID.x;
    values[i] = values[(i + 1) % count] + 1;
}
