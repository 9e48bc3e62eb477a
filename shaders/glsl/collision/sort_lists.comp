#version 460
// Makes the contact list of every particle or, FACES, of points with faces or, EDGES, of edges with the edges in rows that
// they own, from the pairs that were found: sorted by index, with the contact distance and, hasMemory, the contact memory.
// listsOwners: lists the particles with a candidate; for edges index_rows_by_owner does so.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if defined FACES || defined EDGES
#include "common/kernel.glsl"
const bool hasMemory = true;
#define ENTRIES_OF_PAIR 1u
layout(push_constant) uniform Push { FaceFindPush push; };
#define OWNERS push.points
#else
#define MAY_RUN_LISTED
#include "common/kernel.glsl"
layout(constant_id = 1) const bool hasMemory = false;
layout(constant_id = 2) const bool listsOwners = false;
#define ENTRIES_OF_PAIR 2u
layout(push_constant) uniform Push { FindPush push; };
#define OWNERS push.count
#endif
#define PAIRS_BINDING 0
#include "collision/listed_pairs.glsl"
layout(std430, binding = 1) buffer Chains { uint chains[]; };
layout(std430, binding = 2) readonly buffer Radii { float radii[]; }; // EDGES: their thickness
layout(std430, binding = 3) buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 4) buffer Lists { uvec2 lists[]; };
layout(std430, binding = 5) buffer Status { StatusWords status; };
layout(std430, binding = 6) buffer Bounds { GridBounds bounds; };
layout(std430, binding = 7) writeonly buffer Memory { vec4 memory[]; };
layout(std430, binding = 8) readonly buffer Kept { vec4 kept[]; };
layout(std430, binding = 9) readonly buffer KeptOthers { uint keptOthers[]; };
layout(std430, binding = 10) readonly buffer KeptLists { uvec2 keptLists[]; };
#ifdef FACES
#define GROUPS_BINDING 11
#define LISTS_PARTICLES
#include "collision/listed_groups.glsl"
#define OWNERS_BINDING (PARTICLES_BINDING + 3)
#elif defined EDGES
#define OWNERS_BINDING 11
#else
#define HITS_BINDING 11
#define HITS_ACCESS
#include "common/hit_masks.glsl"
#define GROUPS_BINDING 12
#define LISTS_OWNERS
#include "collision/listed_groups.glsl"
#endif
#ifdef FACES
layout(std430, binding = PARTICLES_BINDING + 2) readonly buffer Faces { ContactFace faces[]; };
#include "collision/linked_reach.h"
// Entries are 2 x face, + 1 if a link joins the two. The result carries the sign bit of the thickness, which may be
// that of a 0.
uint otherOf(uint entry) { return entry / 2u; }
float reachOf(float own, uint entry) {
    const float thickness = faces[otherOf(entry)].thickness, reach = own + abs(thickness);
    const float linked = (entry & 1u) != 0u ? LINKED_REACH * reach : reach;
    return uintBitsToFloat(floatBitsToUint(linked) | floatBitsToUint(thickness) & 0x80000000u);
}
#else
uint otherOf(uint entry) { return entry; }
float reachOf(float own, uint other) { return own + radii[other]; }
#endif
#ifdef OWNERS_BINDING
layout(std430, binding = OWNERS_BINDING) writeonly buffer Owners { uint owners[]; }; // one per element
#endif

void listTouching(uint i) {
#ifdef LISTS_OWNERS
    if (listsOwners) listOwner(i);
#elif defined LISTS_PARTICLES
    listParticle(i);
#endif
}

uint owner;
float own; // radius, or thickness [m]
void place(uint element, uint entry) { contacts[element].other = entry; }
void complete(uint element) {
    const uint entry = contacts[element].other;
    contacts[element] = ContactCandidate(otherOf(entry), reachOf(own, entry));
    if (hasMemory) memory[element] = vec4(0.0);
#ifdef OWNERS_BINDING
    owners[element] = owner;
#endif
}
#include "collision/sort_pairs.glsl"

#ifdef HITS_BINDING
// Until contacts are counted, what is remembered of a candidate says whether it has touched.
void clearHits(uvec2 list, uint i) {
    for (uint word = 0u; word < wordsOf(list); ++word) hits[hitWord(OWNERS, i, list, word)] = uvec2(0u);
}
void setHit(uvec2 list, uint i, uint element) {
    const uint place = element - list.x;
    hits[hitWord(OWNERS, i, list, place / 32u)].x |= 1u << place % 32u;
}
#endif

// Gives back what is kept of candidates that are listed again; complete() has cleared all. Both lists are sorted.
void returnMemory(uvec2 list, uint i) {
    if (!hasMemory) return;
#ifdef HITS_BINDING
    clearHits(list, i);
#endif
    uint element = list.x, end = list.x + list.y;
    for (uint place = keptLists[i].x; place < keptLists[i].x + keptLists[i].y; ++place) {
        const uint other = keptOthers[place];
        while (element < end && contacts[element].other < other) ++element;
        if (element == end) break;
        if (contacts[element].other != other) continue;
        memory[element] = kept[place];
#ifdef HITS_BINDING
        setHit(list, i, element);
#endif
    }
}

#ifdef OWNERS_BINDING
#define ITEMS bounds.owners // those that have a pair; lists of all others are empty
#else
#define ITEMS OWNERS
#define ownerAt(i) i
#endif

// Reports a list that is too long, and a lack of capacity as plan_rows does for rows. Returns the length of the list.
uint checked(uint i, uint n) {
    const uint room = push.room / ENTRIES_OF_PAIR, found = min(bounds.pairs, 4u * room + 1u);
    if (found <= room && n > LIST_MOST) atomicMax(status.candidates, CONTACT_MOST_ROOM + 1u);
#ifndef OWNERS_BINDING
    if (placeOfAll() == 0u && found > room && status.candidates == 0u) status.candidates = (ENTRIES_OF_PAIR * found - 1u) / OWNERS + 1u;
#endif
    return min(n, LIST_MOST);
}

void main() {
    const uint item = itemIndex(ITEMS);
    if (item >= ITEMS) return;
    const uint i = ownerAt(item), chain = chains[i], n = checked(i, lengthOf(chain));
    uvec2 list = uvec2(0u, n);
    if (n > 0u) list.x = atomicAdd(bounds.entries, n);
    owner = i;
    own = radii[i];
    sortChain(chain, list.x, n);
    returnMemory(list, i);
    lists[i] = list;
    if (n > 0u) listTouching(i);
    chains[i] = 0u;
}
