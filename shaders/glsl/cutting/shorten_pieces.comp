#version 460
// Connected components, second half of a round: every node takes the label at the end of its chain.
#extension GL_GOOGLE_include_directive : require
#include "common/cut.glsl"

layout(std430, binding = 0) buffer Labels { uint labels[]; };

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count) return;
    const uint i = push.first + item;
    uint label = labels[i];
    for (uint next = labels[label]; next != label; next = labels[label]) label = next;
    labels[i] = label;
}
