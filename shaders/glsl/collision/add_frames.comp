#version 460
// Frames of bodies, second pass: adds up one sum of a body over its chunks.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Partial { vec4 partial[]; };
layout(std430, binding = 1) readonly buffer Bodies { FrameBody bodies[]; };
layout(std430, binding = 2) writeonly buffer Sums { vec4 sums[]; };
layout(push_constant) uniform Push { FramePush push; };

void main() {
    const uint item = itemIndex(push.bodies * FRAME_SUMS);
    if (item >= push.bodies * FRAME_SUMS) return;
    const uint b = item / FRAME_SUMS, k = item % FRAME_SUMS;
    const FrameBody body = bodies[b];
    vec4 sum = vec4(0.0), low = vec4(1e30), high = vec4(-1e30);
    for (uint c = body.firstChunk; c < body.firstChunk + body.chunks; ++c) {
        const vec4 one = partial[c * FRAME_SUMS + k];
        sum += one;
        low = min(low, one);
        high = max(high, one);
    }
    sums[item] = k == FRAME_SUM_LOW ? low : k == FRAME_SUM_HIGH ? high : sum;
}
