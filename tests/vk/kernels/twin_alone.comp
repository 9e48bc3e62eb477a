// A texel twin without the storage block with its buffer: refused.
#version 460
layout(local_size_x = 64) in;
layout(std430, binding = 0) writeonly buffer Sums { vec4 sums[]; };
layout(binding = 33) uniform samplerBuffer weights; // of binding 1, which does not exist

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < sums.length()) sums[i] = texelFetch(weights, int(i));
}
