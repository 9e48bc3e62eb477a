#version 460
// Carries contact lists with their memory to another program, in which owners and their partners have other indices:
// one invocation an owner. Pairs with a partner that is gone end; lists stay sorted by partner. Entries keep their
// places in the pool, behind those that the lists of new owners begin with; what finds no room there is forgotten.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"

layout(std430, binding = 0) readonly buffer Origins { uint origins[]; }; // by owner: its index before, or NO_ELEMENT
layout(std430, binding = 1) readonly buffer Targets { uint targets[]; }; // by index of a partner before: the index now
layout(std430, binding = 2) readonly buffer RangesBefore { ListRange rangesBefore[]; };
layout(std430, binding = 3) readonly buffer EntriesBefore { uint entriesBefore[]; }; // partner first
layout(std430, binding = 4) readonly buffer MemoryBefore { vec4 memoryBefore[]; };
layout(std430, binding = 5) writeonly buffer Ranges { ListRange ranges[]; };
layout(std430, binding = 6) buffer Entries { uint entries[]; };
layout(std430, binding = 7) buffer Memory { vec4 memory[]; };
layout(push_constant) uniform Push { CarryContactsPush push; };

void main() {
    const uint i = itemIndex(push.count);
    if (i >= push.count || origins[i] == NO_ELEMENT) return;
    const ListRange before = rangesBefore[origins[i]];
    const uint first = push.first + before.first;
    uint kept = 0u;
    for (uint e = before.first; e < before.first + before.count; ++e) {
        const uint partner = entriesBefore[e * push.words];
        const uint now = partner < push.partners ? targets[partner] : NO_ELEMENT;
        if (now == NO_ELEMENT || first + kept >= push.room) continue;
        uint place = first + kept++;
        for (; place > first && entries[(place - 1u) * push.words] > now; --place) { // seldom: most keep their order
            for (uint w = 0u; w < push.words; ++w)
                entries[place * push.words + w] = entries[(place - 1u) * push.words + w];
            memory[place] = memory[place - 1u];
        }
        entries[place * push.words] = now;
        for (uint w = 1u; w < push.words; ++w) entries[place * push.words + w] = entriesBefore[e * push.words + w];
        memory[place] = memoryBefore[e];
    }
    ranges[i] = ListRange(kept > 0u ? first : 0u, kept);
}
