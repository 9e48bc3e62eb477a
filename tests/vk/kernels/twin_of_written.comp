// A texel twin of a block that is written, without Aliased: refused.
#version 460
layout(local_size_x = 64) in;
layout(std430, binding = 0) buffer Sums { vec4 sums[]; };
layout(binding = 32) uniform samplerBuffer before;

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < sums.length()) sums[i] += texelFetch(before, int(i));
}
