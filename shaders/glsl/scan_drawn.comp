#version 460
// Prefix sum over the words of a mixed skin: start of each word's triangles among the drawn ones, which keep their
// order; and their number. A group for each skin.
#extension GL_GOOGLE_include_directive : require
#include "kernel.glsl"

layout(std430, binding = 0) readonly buffer Skins { MixedWords skins[]; };
layout(std430, binding = 1) readonly buffer Drawn { uint drawn[]; };
layout(std430, binding = 2) writeonly buffer Starts { uint starts[]; }; // by word [triangles]
layout(std430, binding = 3) writeonly buffer Draws { DrawArguments draws[]; };
layout(push_constant) uniform Push { CountPush push; };

shared uint ofLane[GROUP_SIZE];

void main() { // whole groups: no invocation leaves early
    const uint item = itemIndex(push.count), lane = item % GROUP_SIZE, skin = item / GROUP_SIZE;
    const MixedWords words = skins[skin];
    const uint share = (words.count + GROUP_SIZE - 1u) / GROUP_SIZE;
    const uint first = words.first + min(lane * share, words.count), end = words.first + min((lane + 1u) * share, words.count);
    uint sum = 0u;
    for (uint word = first; word < end; ++word) sum += uint(bitCount(drawn[word]));
    ofLane[lane] = sum;
    barrier();
    uint start = MIXED_WORD * words.first, total = 0u;
    for (uint l = 0u; l < GROUP_SIZE; ++l) {
        if (l < lane) start += ofLane[l];
        total += ofLane[l];
    }
    for (uint word = first; word < end; ++word) {
        starts[word] = start;
        start += uint(bitCount(drawn[word]));
    }
    if (lane == 0u) draws[skin] = DrawArguments(3u * total, 1u, 3u * MIXED_WORD * words.first, 0, 0u);
}
