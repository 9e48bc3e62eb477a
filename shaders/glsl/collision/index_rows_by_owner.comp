#version 460
// Links every moving face, or every edge, to its rows in the lists of others, sorted by owner, so that its
// corners find the impulses of those contacts. Lists the groups of particles with contacts, and writes the number of
// groups of elements.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "common/kernel.glsl"

layout(push_constant) uniform Push { FaceFindPush push; };
#define PAIRS_BINDING 0
#define ENTRIES_OF_PAIR 1u
#include "collision/listed_pairs.glsl"
layout(std430, binding = 1) buffer Chains { uint chains[]; }; // chains of links
layout(std430, binding = 2) readonly buffer Contacts { ContactCandidate contacts[]; };
layout(std430, binding = 3) readonly buffer Lists { uvec2 lists[]; };
layout(std430, binding = 4) buffer Links { uint links[]; }; // elements of contacts
layout(std430, binding = 5) writeonly buffer LinkLists { uvec2 linkLists[]; };
layout(std430, binding = 6) buffer Points { uint apart[]; }; // FACE_POINTS_...
layout(std430, binding = 7) buffer Bounds { GridBounds bounds; };
layout(std430, binding = 8) readonly buffer Shapes { uvec4 shapes[]; }; // ContactFace or ContactEdge
#include "collision/row_kind.glsl"
layout(std430, binding = 9) buffer Status { StatusWords status; };
#define GROUPS_BINDING 10
#define LISTS_PARTICLES
#include "collision/listed_groups.glsl"

// A point lists its own group in sort_lists.
void listGroups(uint shape, bool isLinked) {
    const bool isOwner = areEdges && lists[shape].y > 0u;
    if (!isOwner && !isLinked) return;
    listParticle(shapes[shape].x);
    listParticle(shapes[shape].y);
    if (!areEdges) listParticle(shapes[shape].z);
}

uint shape;
void place(uint link, uint owner) { links[link] = owner; }
void complete(uint link) {
    const uint owner = links[link];
    uint low = lists[owner].x, high = low + lists[owner].y;
    while (low < high) {
        const uint middle = (low + high) / 2u;
        if (contacts[middle].other < shape) low = middle + 1u;
        else high = middle;
    }
    links[link] = min(low, push.room - 1u); // missing only if the step will be undone
}
#include "collision/motion_classes.glsl"
#include "collision/sort_pairs.glsl"

// Points that go far along their headings make every search wide: the next lists look less far ahead.
void planHorizon() {
    const float far = 4.0 * uintBitsToFloat(apart[FACE_POINTS_UNIT]), most = mostMotion();
    const float share = 1.0 + bounds.aheadShare;
    bounds.aheadShare = (most > far ? max(0.7 * share, 0.125) : min(1.4 * share, 1.0)) - 1.0;
}

void main() {
    const uint f = itemIndex(push.moving);
    if (f == 0u) {
        planHorizon();
        for (uint k = 0u; k < FACE_POINTS_FIRST; ++k) apart[k] = 0u; // for the next build
        arguments[2] = DispatchArguments(min((bounds.entries + GROUP_SIZE - 1u) / GROUP_SIZE, uint(ROWS_MOST_GROUPS)), 1u, 1u, 0u);
    }
    if (f >= push.moving) return;
    const uint chain = chains[f], all = lengthOf(chain), n = min(all, LIST_MOST);
    if (all > LIST_MOST) atomicMax(status.candidates, CONTACT_MOST_ROOM + 1u); // reported as overflow
    uvec2 list = uvec2(0u, n);
    if (n > 0u) list.x = atomicAdd(bounds.links, n);
    listGroups(f, n > 0u);
    shape = f;
    sortChain(chain, list.x, n);
    linkLists[f] = list;
    chains[f] = 0u;
}
