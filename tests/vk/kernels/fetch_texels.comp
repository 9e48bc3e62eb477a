// Reads one element of each kind of texel buffer.
#version 460
layout(local_size_x = 64) in;
layout(binding = 0) uniform samplerBuffer weights;
layout(binding = 1) uniform usamplerBuffer codes;
layout(std430, binding = 2) writeonly buffer Sums { vec4 sums[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < sums.length()) sums[i] = texelFetch(weights, int(i)) + vec4(texelFetch(codes, int(i)));
}
