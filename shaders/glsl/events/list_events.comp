#version 460
// Lists the events of a step in order, from the sets of find_events.comp, and their number. One group: an invocation
// lists the events of a run of words.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "events/events.h"

layout(std430, binding = 0) readonly buffer Found { uint found[]; };
layout(std430, binding = 1) readonly buffer Contacts { uint contacts[]; }; // by body and partner
layout(std430, binding = 2) readonly buffer Noted { BodyEvents noted[]; };
layout(std430, binding = 3) readonly buffer Pieces { uint pieces[]; };
layout(std430, binding = 4) readonly buffer Status { StatusWords status; };
layout(std430, binding = 5) writeonly buffer List { EventEntry list[]; };
layout(constant_id = 2) const bool haveContacts = false;
layout(constant_id = 3) const bool mayBeCut = false;
layout(push_constant) uniform Push { EventPush push; }; // count: words of all sets

shared uint sums[GROUP_SIZE];

uint setWords(uint kind) { return kind <= EVENT_CONTACT_ENDS ? push.bodies * push.rowWords : (push.bodies + 31u) / 32u; }

uint countOf(uint kind, uint body) {
    if (kind == EVENT_CUT) return noted[body].cut;
    if (kind == EVENT_TEAR) return noted[body].torn;
    if (kind == EVENT_FRAGMENTS) return noted[body].fragments;
    return kind == EVENT_PIECES && mayBeCut ? pieces[body] : 0u;
}

EventEntry entryOf(uint word, uint bit) {
    uint kind = haveContacts ? EVENT_CONTACT_BEGINS : EVENT_CUT;
    for (; word >= setWords(kind); ++kind) word -= setWords(kind);
    if (!haveContacts || kind > EVENT_CONTACT_ENDS)
        return EventEntry(kind, 32u * word + bit, 0u, countOf(kind, 32u * word + bit));
    return EventEntry(kind, word / push.rowWords, 32u * (word % push.rowWords) + bit, contacts[32u * word + bit]);
}

void main() {
    const uint lane = gl_LocalInvocationID.x, run = (push.count + GROUP_SIZE - 1u) / GROUP_SIZE;
    const uint first = min(lane * run, push.count), end = min(first + run, push.count);
    if (!isFinished(status)) return;
    uint sum = 0u;
    for (uint word = first; word < end; ++word) sum += uint(bitCount(found[word]));
    sums[lane] = sum;
    barrier();
    uint place = 0u;
    for (uint l = 0u; l < lane; ++l) place += sums[l];
    if (lane == GROUP_SIZE - 1u) list[0] = EventEntry(place + sum, 0u, 0u, 0u);
    for (uint word = first; word < end && sum > 0u; ++word)
        for (uint set = found[word]; set != 0u && place < push.room; set &= set - 1u)
            list[++place] = entryOf(word, uint(findLSB(set)));
}
