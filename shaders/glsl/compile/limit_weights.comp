#version 460
// Lowers the w of positions to the most that it may be, where the state itself moves it: the clamp of `split` by
// directions. A state of another material or of the clamp by the sum keeps a smaller one, which returns.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) buffer Positions { vec4 positions[]; };
layout(std430, binding = 1) readonly buffer Most { float most[]; };
layout(push_constant) uniform Push { CountPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i < push.count) positions[i].w = min(positions[i].w, most[i]);
}
