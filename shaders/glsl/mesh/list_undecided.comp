#version 460
// Lists the doubtful samples as word x 32 + bit. Their order varies and changes nothing.
#extension GL_GOOGLE_include_directive : require
#include "mesh/voxel.glsl"

layout(std430, binding = 0) readonly buffer Doubtful { uint doubtfulWords[]; };
layout(std430, binding = 1) buffer Count { uint listed; };
layout(std430, binding = 2) writeonly buffer Samples { uint doubtfulSamples[]; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count) return;
    const uint word = push.first + i;
    const uint bits = doubtfulWords[word];
    if (bits == 0u) return;
    uint slot = atomicAdd(listed, uint(bitCount(bits)));
    for (uint bit = 0u; bit < 32u; ++bit)
        if ((bits >> bit & 1u) != 0u) doubtfulSamples[slot++] = word * 32u + bit;
}
