#version 460
// Lists the slots of cells near dead links: those with a marked corner. An invocation handles the 32 slots of a word.
// The order of the list varies and changes nothing.
#extension GL_GOOGLE_include_directive : require
#include "common/cut.glsl"

layout(std430, binding = 0) readonly buffer Dirty { uint dirty[]; };
layout(std430, binding = 1) buffer Counts { uint counts[]; };         // number of slots, by run
layout(std430, binding = 2) writeonly buffer Listed { uint listed[]; }; // each run begins at its first slot

// The marks of 32 slots from `slot` on; none beyond the run.
uint marksFrom(uint slot) {
    const uint end = push.first + push.count - 1u >> 5, word = slot >> 5, shift = slot & 31u;
    const uint low = word <= end ? dirty[word] : 0u, high = word < end && shift > 0u ? dirty[word + 1u] : 0u;
    return low >> shift | (high << 31u - shift) << 1;
}

void main() {
    const uint firstWord = push.first >> 5, words = (push.first + push.count - 1u >> 5) - firstWord + 1u;
    const uint item = itemIndex(words);
    if (item >= words) return;
    const uint start = firstWord + item << 5;
    uint marks = 0u;
    for (int z = 0; z < 2; ++z)
        for (int y = 0; y < 2; ++y) {
            const uint row = start + uint(offsetOf(ivec3(0, y, z)));
            marks |= marksFrom(row) | marksFrom(row + 1u);
        }
    if (start < push.first) marks &= ~0u << push.first - start; // slots of the run before
    if (start + 32u > push.first + push.count) marks &= ~0u >> start + 32u - push.first - push.count;
    if (marks == 0u) return;
    uint next = push.first + atomicAdd(counts[push.run], uint(bitCount(marks)));
    for (; marks != 0u; marks &= marks - 1u) listed[next++] = start + uint(findLSB(marks));
}
