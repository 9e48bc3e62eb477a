#version 460
// Finds the events of a step as sets: 32 pairs of a body and its partners an invocation, or 32 bodies. An undone step
// has none, and leaves what the next step is compared with.
#extension GL_GOOGLE_include_directive : require
#include "common/kernel.glsl"
#include "events/events.h"
#include "events/absent.glsl"

layout(std430, binding = 0) readonly buffer Contacts { uint contacts[]; }; // of this step, by body and partner
layout(std430, binding = 1) buffer Touching { uint touching[]; }; // 0 = they do not touch, else 1 + steps since they did
layout(std430, binding = 2) buffer Noted { BodyEvents noted[]; };
layout(std430, binding = 3) buffer Slept { uint slept[]; };           // by body: 1 = it slept after the step before
layout(std430, binding = 4) readonly buffer Pieces { uint pieces[]; }; // by body, where links died; then fragments
layout(std430, binding = 5) buffer PiecesBefore { uint piecesBefore[]; };
layout(std430, binding = 6) readonly buffer Status { StatusWords status; };
layout(std430, binding = 7) writeonly buffer Found { uint found[]; };
layout(constant_id = 1) const bool maySleep = false;
layout(constant_id = 2) const bool haveContacts = false;
layout(constant_id = 3) const bool mayBeCut = false;
layout(constant_id = 4) const bool mayComeBack = false; // bodies of the pool come whole
layout(std430, binding = 8) readonly buffer Changes { uint changes[]; }; // POOL_...
layout(std430, binding = 9) readonly buffer WholePieces { uint wholePieces[]; };
layout(push_constant) uniform Push { EventPush push; };

bool isListed(uint kind) { return (push.kinds >> kind & 1u) != 0u; }

// True if contacts of sleeping particles, which no pass counts, may remain.
bool restsWholly(uint body) { return body >= push.bodies || noted[body].asleep != 0u || noted[body].awake == 0u; }

uint after(uint before, uint count, uint body, uint partner) {
    if (count > 0u) return 1u;
    if (before == 0u || maySleep && restsWholly(body) && restsWholly(partner)) return before;
    return before < EVENT_STEPS_APART ? before + 1u : 0u;
}

void findContacts(uint word) {
    const uint body = word / push.rowWords, first = 32u * (word % push.rowWords);
    uint begins = 0u, ends = 0u;
    for (uint bit = 0u; bit < min(32u, push.partners - first); ++bit) {
        const uint pair = 32u * word + bit, before = touching[pair];
        const uint now = after(before, contacts[pair], body, first + bit);
        if (now == before) continue;
        touching[pair] = now;
        if (before == 0u) begins |= 1u << bit;
        if (now == 0u) ends |= 1u << bit;
    }
    found[word] = isListed(EVENT_CONTACT_BEGINS) ? begins : 0u;
    found[push.bodies * push.rowWords + word] = isListed(EVENT_CONTACT_ENDS) ? ends : 0u;
}

bool hasSlept(uint body) {
    if (!maySleep) return false;
    const uint before = slept[body];
    slept[body] = noted[body].awake != 0u ? 0u : noted[body].asleep != 0u ? 1u : before;
    return slept[body] != before && noted[body].awake != EVENT_ABSENT;
}

// Notes the change of a count since the last cut of a body: of its pieces, or of its removed fragments.
uint change(uint body, uint index) {
    if (!mayBeCut) return 0u;
    if (mayComeBack && changes[body] >= POOL_GONE) piecesBefore[index] = wholePieces[index];
    if ((noted[body].cut | noted[body].torn) == 0u) return 0u;
    const uint before = piecesBefore[index];
    piecesBefore[index] = pieces[index];
    return pieces[index] - before;
}

void findOthers(uint word, uint words) {
    uint cut = 0u, torn = 0u, parted = 0u, sleeps = 0u, wakes = 0u, crumbled = 0u;
    for (uint body = 32u * word; body < min(32u * word + 32u, push.bodies); ++body) {
        const uint bit = 1u << (body & 31u);
        if (noted[body].cut > 0u) cut |= bit;
        if (noted[body].torn > 0u) torn |= bit;
        if (change(body, body) != 0u) parted |= bit;
        const uint fragments = change(body, push.bodies + body);
        if (int(fragments) > 0) {
            crumbled |= bit;
            noted[body].fragments = fragments;
        }
        if (hasSlept(body)) {
            if (slept[body] != 0u) sleeps |= bit;
            else wakes |= bit;
        }
    }
    const uint sets[6] = uint[](cut, torn, parted, sleeps, wakes, crumbled);
    const uint start = (haveContacts ? 2u * push.bodies * push.rowWords : 0u) + word;
    for (uint k = 0u; k < 6u; ++k)
        found[start + k * words] = isListed(EVENT_CUT + k) ? sets[k] : 0u;
}

void main() {
    const uint item = itemIndex(push.count);
    if (item >= push.count || !isFinished(status)) return;
    const uint pairs = haveContacts ? push.bodies * push.rowWords : 0u;
    if (haveContacts && item < pairs) findContacts(item);
    else findOthers(item - pairs, push.count - pairs);
}
